/* Writes notes about unexpected properties of the isotherms.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/numerics/master_fit.h"

#include "core/base/clocale.h"

#include <math.h>
#include <stdarg.h>
#include <string.h>

/* Thresholds of notes; they change no number. An isotherm with three times the noise of the
 * others is named. By chance ten points of both moduli have a third more noise in one of forty.
 * A vertical shift 0.1 decade from the physical one is named: 26 %, which no change of density
 * with temperature causes. */
static const double noise_factor_limit = 3.0, vertical_deviation_limit = 0.1;
/* Strain amplitudes with a larger ratio are different points of the Payne curve. At its steepest
 * it falls by a fifth of its height between them (Kraus 1984, with m = 0.6). Used for a note
 * only. */
static const double strain_ratio_limit = 2.0;
/* Runs within 0.5 K, the stability of a chamber, have one temperature. A difference of four
 * standard errors occurs by chance in one pair of 16,000. */
static const double same_temperature = 0.5, difference_limit = 4.0;

void master_add_note(wt_master_shift *shift, const char *format, ...)
{
    const size_t size = sizeof shift->note;
    size_t length = strlen(shift->note);
    if (length > 0 && length + 3 < size) {
        memcpy(shift->note + length, "; ", 3);
        length += 2;
    }
    va_list arguments;
    va_start(arguments, format);
    const int needed = clocale_vprint(shift->note + length, size - length, format, arguments);
    va_end(arguments);
    if (needed >= 0 && (size_t)needed >= size - length)
        memcpy(shift->note + size - 4, "...", 4);
}

static void note_shift(const master_work *work, size_t i, wt_master_shift *shift)
{
    const wt_posterior *p = work->posterior;
    if (work->set.curves[i].n_skipped > 0)
        master_add_note(shift, "%zu point%s without positive modulus left out",
                        work->set.curves[i].n_skipped,
                        work->set.curves[i].n_skipped > 1 ? "s" : "");
    if (shift->n_outliers > 0)
        master_add_note(shift, "%zu value%s off the curve left out", shift->n_outliers,
                        shift->n_outliers > 1 ? "s" : "");
    if (shift->noise_factor > noise_factor_limit)
        master_add_note(shift, "%.1f times the noise of the others", shift->noise_factor);
    if (!shift->determined)
        return;
    if (work->set.curves[i].is_shift_fixed && work->route == WT_SHIFTS_FROM_SPECTRUM)
        master_add_note(shift, "as given");
    if (work->options.vertical != WT_VERTICAL_NONE && isfinite(shift->log_b.value) &&
        fabs(shift->log_b.value - shift->log_b_physical) > vertical_deviation_limit)
        master_add_note(shift, "log bT %+.3f where rho T gives %+.3f", shift->log_b.value,
                        shift->log_b_physical);
    if (p->shape.kind != WT_LAW_NONE && p->shape.outlier == (long)work->curve[i]) {
        const double off = posterior_constant(p, law_outlier_index(&p->shape)).value;
        master_add_note(shift, "off the law by %+.2f decade, as if %+.1f K from its temperature",
                        off, off / p->slope[work->curve[i]]);
    }
}

/* Notes runs at one temperature with significantly different shifts. */
static void note_repeated_runs(wt_master *m)
{
    for (size_t i = 1; i < m->n_shifts; i++) {
        wt_master_shift *shift = &m->shifts[i];
        const wt_master_shift *before = &m->shifts[i - 1];
        if (!shift->determined || !before->determined ||
            shift->temperature - before->temperature > same_temperature)
            continue;
        const double difference = shift->log_a.value - before->log_a.value;
        if (fabs(difference) >
            difference_limit * hypot(shift->log_a.standard_error, before->log_a.standard_error))
            master_add_note(shift, "log aT differs by %+.3f from the other run at this temperature",
                            difference);
    }
}

/* Warns if the mean strain amplitudes of the isotherms differ too much. */
static void note_strain(const wt_sweep *sweep, wt_log *log)
{
    double low = HUGE_VAL, high = 0.0;
    for (size_t i = 0; i < sweep->n_isotherms; i++) {
        const wt_isotherm *isotherm = &sweep->isotherms[i];
        double sum = 0.0;
        size_t n = 0;
        for (size_t k = 0; isotherm->strain != NULL && k < isotherm->n; k++)
            if (isotherm->strain[k] > 0.0) {
                sum += log10(isotherm->strain[k]);
                n++;
            }
        if (n > 0) {
            low = fmin(low, pow(10.0, sum / (double)n));
            high = fmax(high, pow(10.0, sum / (double)n));
        }
    }
    if (high > strain_ratio_limit * low)
        wt_log_add(log, WT_WARNING, NULL, NULL,
                   "isotherms were measured at strain amplitudes from %.2g to %.2g: a filled "
                   "rubber softens with strain, so their shifts mix temperature and strain",
                   low, high);
}

/* Warns about the limitations of a fit to one quantity. */
static void note_quantity(const master_work *work, wt_log *log)
{
    static const char *const open[] = {
        [WT_SHIFT_STORAGE] =
            "fitted to the storage modulus alone: the loss modulus is what its slope "
            "demands (Kramers-Kronig), and superposition is not tested",
        [WT_SHIFT_LOSS] = "fitted to the loss modulus alone: no equilibrium modulus, so no storage "
                          "modulus and no series, and superposition is not tested",
        [WT_SHIFT_LOSS_FACTOR] =
            "fitted to the loss factor alone: shifts and their law, but no level of "
            "the moduli, no vertical shift and no series, and superposition is not "
            "tested"};
    if (work->set.loading != WT_OSCILLATION)
        wt_log_add(log, WT_WARNING, NULL, NULL,
                   "fitted to %s: storage and loss modulus are those of the spectrum, and "
                   "superposition is not tested",
                   work->set.loading == WT_CREEP ? "creep compliances" : "relaxation moduli");
    if (work->flows)
        wt_log_add(log, WT_WARNING, NULL, NULL,
                   "creep of a liquid is fitted with an equilibrium modulus, which stands for "
                   "what flows: shifts, law and moduli at the measured times are those of the "
                   "liquid, and it is too stiff at longer ones");
    else if (work->set.loading == WT_OSCILLATION && work->set.quantity != WT_SHIFT_MODULI)
        wt_log_add(log, WT_WARNING, NULL, NULL, "%s", open[work->set.quantity]);
}

/* Notes the route by which the shifts were found, if it is not one spectrum. */
static void note_route(const master_work *work, wt_log *log)
{
    size_t measured = 0, left = 0;
    for (size_t i = 0; i < work->set.n; i++)
        if (work->set.curves[i].n_merged > 0) {
            measured += work->set.curves[i].n_merged;
            left += work->set.curves[i].n;
        }
    if (measured > 0)
        wt_log_add(log, WT_NOTE, NULL, NULL,
                   "%zu points of dense isotherms are fitted as %zu means, each over a tenth "
                   "of a decade at most",
                   measured, left);
    if (work->part)
        wt_log_add(log, WT_WARNING, NULL, NULL,
                   "spectrum, law and series are those of the isotherms from %.1f to %.1f °C, "
                   "which one spectrum describes; shifts of the others are by the overlap of "
                   "their storage modulus with their neighbours'",
                   work->set.curves[work->first].temperature - WT_ZERO_CELSIUS,
                   work->set.curves[work->last].temperature - WT_ZERO_CELSIUS);
    else if (work->route == WT_SHIFTS_FROM_OVERLAP)
        wt_log_add(log, WT_WARNING, NULL, NULL,
                   "shifts are by the overlap of the storage modulus alone, from neighbour to "
                   "neighbour and %s: their errors hold what the places of an overlap "
                   "disagree by, and by how much the overlap of E'' and %s would move them; "
                   "E'' of the spectrum is off by what superposition fails by",
                   work->options.vertical == WT_VERTICAL_PHYSICAL
                       ? "with the vertical shift of rubber elasticity"
                       : "without a vertical shift",
                   work->options.vertical == WT_VERTICAL_PHYSICAL
                       ? "no vertical shift"
                       : "the vertical shift of rubber elasticity");
}

void master_add_notes(const master_work *work, const wt_sweep *sweep, wt_master *m, wt_log *log)
{
    note_quantity(work, log);
    note_route(work, log);
    for (size_t i = 0; i < m->n_shifts; i++)
        note_shift(work, i, &m->shifts[i]);
    note_repeated_runs(m);
    note_strain(sweep, log);
    for (size_t i = 0; i < m->n_shifts; i++)
        if (m->shifts[i].note[0] != '\0')
            wt_log_add(log, m->shifts[i].determined ? WT_NOTE : WT_WARNING, NULL, NULL,
                       "isotherm of %.2f °C: %s", m->shifts[i].temperature - WT_ZERO_CELSIUS,
                       m->shifts[i].note);
    if (work->lines)
        wt_log_add(log, WT_WARNING, NULL, NULL,
                   "the spectrum is one of few sharp processes: between their lines nothing "
                   "is measured, and the errors of E'', of the series and of what is worked "
                   "out with it are up to twice as large as stated");
    if (m->n_shifts > 1 && (m->reference_temperature < m->shifts[0].temperature ||
                            m->reference_temperature > m->shifts[m->n_shifts - 1].temperature))
        wt_log_add(log, WT_WARNING, NULL, NULL,
                   "the reference temperature is outside the isotherms: the law is "
                   "extrapolated");
    if (m->n_shifts > 1 && work->set.quantity == WT_SHIFT_MODULI &&
        m->superposition != WT_SUPERPOSITION_HOLDS)
        wt_log_add_topic(log, WT_WARNING, WT_TOPIC_SUPERPOSITION, NULL, NULL,
                         "time-temperature superposition %s%s%s",
                         m->superposition == WT_SUPERPOSITION_FAILS ? "fails" : "cannot be judged",
                         isnan(m->valid_from) ? ": " : " ", m->superposition_reason);
    if (m->law.kind != WT_LAW_NONE && m->law_rms > master_max_shift_error)
        wt_log_add(log, WT_WARNING, NULL, NULL,
                   "the law of the shift factors is %.2g decade off them (rms): it is none of "
                   "this material, and what is worked out at other temperatures with it is off "
                   "by as much",
                   m->law_rms);
    if (m->law.kind == WT_LAW_NONE && m->n_shifts > 1)
        wt_log_add(log, WT_WARNING, NULL, NULL, "no law of the shift factors: %s",
                   m->no_law_reason);
}
