/* Verdict on superposition and how to decide it, and remarks on the isotherms.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/numerics/master_fit.h"

#include "core/base/number.h"
#include "core/base/text.h"

#include <math.h>
#include <stdarg.h>
#include <string.h>

/* A shift with a larger error is not determined [decade]. Its 95 % interval is most of a decade,
 * as wide as a step of 5 to 10 K between isotherms. */
const double master_max_shift_error = 0.2;

/* ---- remarks --------------------------------------------------------------------------------- */

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
    if (work->set.curves[i].is_loss_excluded)
        master_add_note(shift, "%s", work->set.curves[i].exclusion);
    if (work->set.curves[i].origin == WT_SHIFT_GIVEN)
        master_add_note(shift, "as given");
    else if (work->set.curves[i].origin == WT_SHIFT_BY_HAND)
        master_add_note(shift, "by hand");
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

/* Stores the range of the mean strain amplitudes of the isotherms and warns if it is too wide. */
static void note_strain(const wt_sweep *sweep, wt_master *m, wt_log *log)
{
    double low = (double)NAN, high = (double)NAN;
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
    m->strain_low = low;
    m->strain_high = high;
    if (high > strain_ratio_limit * low)
        wt_log_add(log, WT_WARNING, NULL, NULL,
                   "isotherms were measured at strain amplitudes from %s to %s: a filled "
                   "rubber softens with strain, so their shifts mix temperature and strain",
                   format_percent(low).text, format_percent(high).text);
}

/* Warns about the limitations of a fit to one quantity. */
static void note_quantity(const master_work *work, wt_log *log)
{
    static const char *const open[] = {
        [WT_SHIFT_STORAGE] =
            "fitted to the storage modulus alone: the loss modulus follows from its slope "
            "(Kramers-Kronig), and superposition is not tested",
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
                   "creep of a liquid is fitted with an equilibrium modulus in place of its "
                   "flow: shifts, law and moduli at the measured times are those of the "
                   "liquid, and the moduli at longer times are too high");
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
                   "which one spectrum describes; the other isotherms are shifted by the "
                   "overlap of their storage modulus with that of their neighbours",
                   work->set.curves[work->first].temperature - WT_ZERO_CELSIUS,
                   work->set.curves[work->last].temperature - WT_ZERO_CELSIUS);
    else if (work->route == WT_SHIFTS_FROM_OVERLAP)
        wt_log_add(log, WT_WARNING, NULL, NULL,
                   "each isotherm is shifted by the overlap of its storage modulus with its "
                   "neighbour, %s; the errors of the shifts contain the differences within an "
                   "overlap, and the changes by the overlap of E'' and by %s; E'' of the "
                   "spectrum deviates from the measured one by the misfit of superposition",
                   work->options.vertical == WT_VERTICAL_PHYSICAL
                       ? "with the vertical shift of rubber elasticity"
                       : "without a vertical shift",
                   work->options.vertical == WT_VERTICAL_PHYSICAL
                       ? "no vertical shift"
                       : "the vertical shift of rubber elasticity");
}

/* Warns once of isotherms with the same note, at the first of them. */
static void warn_of_note(const master_work *work, const wt_master *m, size_t i, wt_log *log)
{
    size_t n = 0, last = i;
    for (size_t k = 0; k < m->n_shifts; k++)
        if (wt_text_repeats(m->shifts[k].note, m->shifts[i].note) &&
            m->shifts[k].determined == m->shifts[i].determined &&
            work->set.curves[k].exclusion[0] == '\0') {
            if (k < i)
                return;
            n++;
            last = k;
        }
    const wt_severity severity = m->shifts[i].determined ? WT_NOTE : WT_WARNING;
    const double celsius = m->shifts[i].temperature - WT_ZERO_CELSIUS;
    if (n == 1)
        wt_log_add(log, severity, NULL, NULL, "isotherm of %.2f °C: %s", celsius,
                   m->shifts[i].note);
    else
        wt_log_add(log, severity, NULL, NULL, "%zu isotherms of %.2f °C to %.2f °C: %s", n, celsius,
                   m->shifts[last].temperature - WT_ZERO_CELSIUS, m->shifts[i].note);
}

/* Standard errors from which an error of the instrument is told: one false note in 370 sets. */
static const double told_errors = 3.0;

static bool is_told(wt_interval x)
{
    return fabs(x.value) > told_errors * x.standard_error;
}

/* Tells the errors of the instrument that the isotherms show, and what is assumed of the frame if
 * that is more than the noise. */
static void note_instrument(const master_work *work, const wt_master *m, wt_log *log)
{
    const double degree = M_PI / 180.0;
    const char *const corrected =
        m->superposition == WT_SUPERPOSITION_FAILS
            ? "shifts, law and spectrum are corrected for it; as superposition fails, the material "
              "may be the cause instead"
            : "shifts, law and spectrum are corrected for it";
    double stiffest = 0.0;
    for (size_t i = 0; i < m->n; i++)
        stiffest = fmax(stiffest, pow(10.0, m->log_storage[i]));
    if (is_told(m->phase_lag))
        wt_log_add(log, WT_WARNING, NULL, NULL,
                   "the phase angle is too %s by %.2g ± %.1g degrees at the highest frequency, in "
                   "proportion to the frequency: %s",
                   m->phase_lag.value > 0.0 ? "large" : "small", fabs(m->phase_lag.value) / degree,
                   m->phase_lag.standard_error / degree, corrected);
    if (is_told(m->inertia))
        wt_log_add(
            log, WT_WARNING, NULL, NULL,
            "the storage modulus is too %s by up to %s (standard error %s), in proportion to "
            "the square of the frequency, as by inertia: %s",
            m->inertia.value > 0.0 ? "low" : "high", format_percent(fabs(m->inertia.value)).text,
            format_percent(m->inertia.standard_error).text, corrected);
    const double assumed = 2.0 * stiffest * m->frame_compliance.standard_error;
    if (assumed > work->s->noise[LOSS])
        wt_log_add(log, WT_NOTE, NULL, NULL,
                   "nothing is stated of the compliance of frame and clamps: the errors contain %s "
                   "of the strain of a sample of 1 GPa, which is %s of the loss modulus where the "
                   "sample is stiffest",
                   format_percent(1e9 * instrument_deviation[FRAME_COMPLIANCE]).text,
                   format_percent(assumed).text);
}

void master_add_notes(const master_work *work, const wt_sweep *sweep, wt_master *m, wt_log *log)
{
    note_quantity(work, log);
    note_route(work, log);
    note_instrument(work, m, log);
    for (size_t i = 0; i < m->n_shifts; i++)
        note_shift(work, i, &m->shifts[i]);
    note_repeated_runs(m);
    note_strain(sweep, m, log);
    for (size_t i = 0; i < m->n_shifts; i++) {
        const shift_curve *const curve = &work->set.curves[i];
        const double celsius = m->shifts[i].temperature - WT_ZERO_CELSIUS;
        if (curve->exclusion[0] != '\0')
            wt_log_action(log, WT_LOSS, WT_LEFT_OUT, 1,
                          curve->has_no_moduli ? NULL : WT_KEEP_OPTION, NULL, NULL,
                          "isotherm of %.2f °C: %s%s", celsius, m->shifts[i].note,
                          curve->has_no_moduli ? "" : "; " WT_KEEP_OPTION " uses it as it is");
        else if (m->shifts[i].note[0] != '\0')
            warn_of_note(work, m, i, log);
    }
    if (work->lines)
        wt_log_add(log, WT_WARNING, NULL, NULL,
                   "the spectrum consists of few sharp lines: nothing is measured between "
                   "them, and the errors of E'', of the series and of results that use it are "
                   "up to twice as large as stated");
    if (m->n_shifts > 1 && (m->reference_temperature < m->shifts[0].temperature ||
                            m->reference_temperature > m->shifts[m->n_shifts - 1].temperature))
        wt_log_add(log, WT_WARNING, NULL, NULL,
                   "the reference temperature is outside the isotherms: the law is "
                   "extrapolated");
    if (m->n_shifts > 1 && work->set.quantity == WT_SHIFT_MODULI &&
        m->superposition != WT_SUPERPOSITION_HOLDS)
        wt_log_add_topic(log, WT_WARNING, WT_TOPIC_WORST_LIMIT, NULL, NULL,
                         "time-temperature superposition %s%s%s",
                         m->superposition == WT_SUPERPOSITION_FAILS ? "fails" : "is inconclusive",
                         isnan(m->valid_from) ? ": " : " ", m->superposition_reason);
    if (m->law.kind != WT_LAW_NONE && m->law_rms > master_max_shift_error)
        wt_log_add(log, WT_WARNING, NULL, NULL,
                   "the law of the shift factors deviates from them by %.2g decade (rms): it "
                   "does not describe this material, and results at other temperatures are "
                   "wrong by as much",
                   m->law_rms);
    if (m->law.kind == WT_LAW_NONE && work->options.sample_temperature_error > 0.0)
        wt_log_add(log, WT_NOTE, NULL, NULL,
                   "without a law of the shift factors, the error of the temperature of the sample "
                   "is in no result");
    if (m->law.kind == WT_LAW_NONE && m->n_shifts > 1)
        wt_log_add(log, WT_WARNING, NULL, NULL, "no law of the shift factors: %s",
                   m->no_law_reason);
}

/* ---- verdict on superposition ---------------------------------------------------------------- */

/* Lack of fit is real below this probability, with what is not known of the noise. The customary
 * level, one wrong "fails" in a hundred sweeps at most, of the two counts of superposition.c
 * together. A smaller one misses second processes (unit_dma_master_fit); at 0.05 one sound sweep of
 * twenty would fail. */
static const double significant = 0.01;
/* Level below which superposition is not reported to hold, with the noise as estimated. The
 * estimated noise factors make small probabilities a few times too small. */
static const double likely_level = 0.01;
/* Relative misfit that fails if certainly exceeded, and that leaves the verdict open if possibly
 * exceeded. Polyisoprene, a simple rubber, has 0.3 to 0.4 % due to the rheometer, so a lower
 * limit would blame the rubber. 1 % of a modulus corresponds to half a per cent in each side of
 * the cross section, which is harmless. */
static const double relevant_misfit = 0.004, possible_misfit = 0.01;
/* Narrower windows hide a second process [decade]. E'' of one relaxation time is 1.14 decades
 * wide at half height, and a window must be wider to separate two. */
static const double least_window = 1.5;
/* Frequencies are exported with four digits, so a window of 1.5 decades may be this much less. */
static const double window_rounding = 0.001;
/* Relevance and significance of the Kramers-Kronig difference between measured and predicted
 * E''. The level of 0.001 is strict, because this is an additional test. */
static const double relevant_loss_factor = 0.01, loss_significant = 0.001;
/* An isotherm with a smaller overlap does not test superposition, because only the smoothness of
 * the spectrum places it [decade]. One step between terms. */
static const double least_overlap = 0.3;
/* Two isotherms can always be superposed. */
enum { LEAST_ISOTHERMS = 3 };

static double widest_window(const master_work *work)
{
    double widest = 0.0; /* a wide window reveals a second process */
    for (size_t i = 0; i < work->set.n; i++) {
        const shift_curve *c = &work->set.curves[i];
        if (work->placed[i])
            widest = fmax(widest, c->x[c->n - 1] - c->x[0]);
    }
    return widest;
}

bool master_misfit_is_significant(const lack_of_fit *lack)
{
    return lack->p_sure < significant && lack->misfit_low > relevant_misfit;
}

bool master_misfit_is_likely(const lack_of_fit *lack)
{
    return lack->p < likely_level;
}

bool master_misfit_is_loss_factor(const lack_of_fit *lack)
{
    return master_loss_is_inconsistent(lack) && !(lack->p_beyond < significant);
}

bool master_loss_is_inconsistent(const lack_of_fit *lack)
{
    return lack->kk < loss_significant &&
           fabs(lack->factor) - 2.0 * lack->factor_error > relevant_loss_factor;
}

/* Describes which temperatures one spectrum misses and by how much. */
static void describe_gross_misfit(const master_work *work, wt_master *m)
{
    const shift_curve *c = work->set.curves;
    char where[128] = "", *at = where;
    const double zero = WT_ZERO_CELSIUS;
    const double *missed = work->part ? work->missed_whole : work->missed;
    if (work->part) {
        const bool cold = work->first > 0, warm = work->last + 1 < work->set.n;
        m->valid_from = c[work->first].temperature;
        m->valid_to = c[work->last].temperature;
        if (cold)
            at += clocale_print(at, 32, "up to %.1f °C%s", c[work->first - 1].temperature - zero,
                                warm ? " and " : "");
        if (warm)
            at += clocale_print(at, 32, "from %.1f °C on", c[work->last + 1].temperature - zero);
        clocale_print(at, 64, ", holds from %.1f to %.1f °C: ", m->valid_from - zero,
                      m->valid_to - zero);
    }
    clocale_print(m->superposition_reason, sizeof m->superposition_reason,
                  "%sone spectrum deviates from E' by %.1f %% and from E'' by %.1f %% beyond their "
                  "noise: a second process, as in a glass, or a change of the material",
                  where, 100.0 * missed[STORAGE], 100.0 * missed[LOSS]);
}

/* Stores the numbers of the test of superposition; NaN without one. */
static void store_lack_of_fit(const lack_of_fit *lack, bool tested, wt_master *m)
{
    const double none = (double)NAN;
    m->lack_of_fit_p = tested ? lack->p : none;
    m->misfit_low = tested ? lack->misfit_low : none;
    m->misfit_high = tested ? lack->misfit_high : none;
    m->kramers_kronig_p = tested ? lack->kk : none;
    m->loss_factor = tested ? lack->factor : none;
    m->loss_factor_error = tested ? lack->factor_error : none;
}

void master_assess(const master_work *work, wt_master *m)
{
    size_t determined = 0;
    const bool failed =
        work->posterior->extra_error != NULL; /* shifts are withheld due to the failure */
    for (size_t i = 0; i < m->n_shifts; i++)
        determined += (m->shifts[i].determined || (failed && work->placed[i])) &&
                      work->overlap[i] >= least_overlap;
    const size_t undetermined = m->n_shifts - determined;
    const lack_of_fit *lack = work->part ? &work->whole : &work->lack;
    const double window = widest_window(work);
    const bool both = work->set.quantity == WT_SHIFT_MODULI;
    store_lack_of_fit(lack, both && work->tested, m);
    m->superposition = WT_SUPERPOSITION_INCONCLUSIVE;
    m->valid_from = m->valid_to = (double)NAN;
    if (!both) {
        clocale_print(m->superposition_reason, sizeof m->superposition_reason,
                      "%s alone does not test it; storage and loss modulus together would",
                      work->set.quantity == WT_SHIFT_LOSS_FACTOR ? "the loss factor"
                                                                 : "one modulus");
    } else if (work->no_spectrum[0] != '\0') {
        clocale_print(m->superposition_reason, sizeof m->superposition_reason,
                      "one spectrum of all was not found (%s)", work->no_spectrum);
    } else if (work->part || work->route == WT_SHIFTS_FROM_OVERLAP) {
        m->superposition = WT_SUPERPOSITION_FAILS;
        m->misfit_low = m->misfit_high = (double)NAN; /* the reason has another measure of it */
        describe_gross_misfit(work, m);
    } else if (determined >= 2 && master_loss_is_inconsistent(lack)) {
        m->superposition = WT_SUPERPOSITION_FAILS;
        clocale_print(m->superposition_reason, sizeof m->superposition_reason,
                      "E'' deviates by %+.1f %% from what E' implies (Kramers-Kronig, p %s): "
                      "check the instrument, the columns, and whether the material changed "
                      "meanwhile",
                      100.0 * expm1(lack->factor), format_probability(lack->kk).text);
    } else if (determined >= LEAST_ISOTHERMS && master_misfit_is_significant(lack)) {
        m->superposition = WT_SUPERPOSITION_FAILS;
        clocale_print(m->superposition_reason, sizeof m->superposition_reason,
                      "one spectrum deviates from the isotherms by %s %% (p %s): a second "
                      "process or a change of the material; treat the temperatures separately",
                      format_range(100.0 * lack->misfit_low, 100.0 * lack->misfit_high, 2).text,
                      format_probability(lack->p_sure).text);
    } else if (determined < LEAST_ISOTHERMS) {
        clocale_print(m->superposition_reason, sizeof m->superposition_reason,
                      "%zu isotherm%s that overlap%s; three or more would decide", determined,
                      determined == 1 ? "" : "s", determined == 1 ? "s" : "");
    } else if (3 * undetermined > m->n_shifts) {
        clocale_print(
            m->superposition_reason, sizeof m->superposition_reason,
            "%zu of %zu shifts not determined; smaller steps of temperature or a wider range "
            "of frequencies would determine them",
            undetermined, m->n_shifts);
    } else if (lack->misfit_high > possible_misfit) {
        clocale_print(
            m->superposition_reason, sizeof m->superposition_reason,
            "a misfit of up to %.1f %% would not be seen; less noise than %.1f %%, or more "
            "points, would show it",
            round_up_percent(lack->misfit_high), 100.0 * fmax(m->noise_storage, m->noise_loss));
    } else if (master_misfit_is_likely(lack)) {
        clocale_print(m->superposition_reason, sizeof m->superposition_reason,
                      "a misfit is likely (p %s) but below %.1f %%",
                      format_probability(lack->p).text, round_up_percent(lack->misfit_high));
    } else if (window < least_window - window_rounding) {
        clocale_print(
            m->superposition_reason, sizeof m->superposition_reason,
            "isotherms over %.1f decades can hide a second process; 1.5 decades or more would "
            "show it",
            window);
    } else {
        m->superposition = WT_SUPERPOSITION_HOLDS;
        clocale_print(m->superposition_reason, sizeof m->superposition_reason,
                      "misfit below %.1f %% (lack of fit p %s)",
                      round_up_percent(lack->misfit_high), format_probability(lack->p).text);
    }
}
