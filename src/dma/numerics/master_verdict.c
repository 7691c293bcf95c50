/* Verdict on superposition and how to decide it. SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/numerics/master_fit.h"

#include "core/base/clocale.h"
#include "core/base/number.h"

#include <math.h>
#include <string.h>

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

/* Converts a bound to per cent and rounds it up. */
static double round_up_percent(double share)
{
    return fmax(0.1, 0.1 * ceil(1e3 * share));
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
    clocale_print(
        m->superposition_reason, sizeof m->superposition_reason,
        "%sone spectrum of all misses E' by %.1f %% and E'' by %.1f %% beyond their noise: "
        "other processes, as in a glass, or a change of the material",
        where, 100.0 * missed[STORAGE], 100.0 * missed[LOSS]);
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
    const bool both = work->set.quantity == WT_SHIFT_MODULI, tested = both && work->tested;
    m->lack_of_fit_p = tested ? lack->p : (double)NAN;
    m->misfit_low = tested ? lack->misfit_low : (double)NAN;
    m->misfit_high = tested ? lack->misfit_high : (double)NAN;
    m->kramers_kronig_p = tested ? lack->kk : (double)NAN;
    m->loss_factor = tested ? lack->factor : (double)NAN;
    m->loss_factor_error = tested ? lack->factor_error : (double)NAN;
    m->superposition = WT_SUPERPOSITION_INCONCLUSIVE;
    m->valid_from = m->valid_to = (double)NAN;
    if (!both) {
        clocale_print(m->superposition_reason, sizeof m->superposition_reason,
                      "%s alone does not tell; storage and loss modulus together would",
                      work->set.quantity == WT_SHIFT_LOSS_FACTOR ? "the loss factor"
                                                                 : "one modulus");
    } else if (work->no_spectrum[0] != '\0') {
        clocale_print(m->superposition_reason, sizeof m->superposition_reason,
                      "one spectrum of all was not found (%s)", work->no_spectrum);
    } else if (work->part || work->route == WT_SHIFTS_FROM_OVERLAP) {
        m->superposition = WT_SUPERPOSITION_FAILS;
        describe_gross_misfit(work, m);
    } else if (determined >= 2 && master_loss_is_inconsistent(lack)) {
        m->superposition = WT_SUPERPOSITION_FAILS;
        clocale_print(m->superposition_reason, sizeof m->superposition_reason,
                      "E'' is %+.1f %% off what E' demands (Kramers-Kronig, p %s): check the "
                      "instrument, the columns, and whether the material changed meanwhile",
                      100.0 * expm1(lack->factor), format_probability(lack->kk).text);
    } else if (determined >= LEAST_ISOTHERMS && master_misfit_is_significant(lack)) {
        m->superposition = WT_SUPERPOSITION_FAILS;
        char low[16], high[16];
        clocale_print(low, sizeof low, "%.1f", 100.0 * lack->misfit_low);
        clocale_print(high, sizeof high, "%.1f", 100.0 * lack->misfit_high);
        const bool one = strcmp(low, high) == 0;
        clocale_print(m->superposition_reason, sizeof m->superposition_reason,
                      "one spectrum misses the isotherms by %s%s%s %% (p %s): a second process "
                      "or a change of the material; treat the temperatures apart",
                      one ? "about " : low, one ? "" : " to ", high,
                      format_probability(lack->p_sure).text);
    } else if (determined < LEAST_ISOTHERMS) {
        clocale_print(m->superposition_reason, sizeof m->superposition_reason,
                      "%zu isotherm%s that overlap%s; three or more would tell", determined,
                      determined == 1 ? "" : "s", determined == 1 ? "s" : "");
    } else if (3 * undetermined > m->n_shifts) {
        clocale_print(
            m->superposition_reason, sizeof m->superposition_reason,
            "%zu of %zu shifts not determined; smaller steps of temperature or a wider range of "
            "frequencies would tell",
            undetermined, m->n_shifts);
    } else if (lack->misfit_high > possible_misfit) {
        clocale_print(
            m->superposition_reason, sizeof m->superposition_reason,
            "a misfit of up to %.1f %% would not be seen; less noise than %.1f %%, or more "
            "points, would tell",
            round_up_percent(lack->misfit_high), 100.0 * fmax(m->noise_storage, m->noise_loss));
    } else if (master_misfit_is_likely(lack)) {
        clocale_print(m->superposition_reason, sizeof m->superposition_reason,
                      "a misfit is likely (p %s) but below %.1f %%",
                      format_probability(lack->p).text, round_up_percent(lack->misfit_high));
    } else if (window < least_window) {
        clocale_print(
            m->superposition_reason, sizeof m->superposition_reason,
            "windows of %.1f decades hide a second process; 1.5 decades or more would tell",
            window);
    } else {
        m->superposition = WT_SUPERPOSITION_HOLDS;
        clocale_print(m->superposition_reason, sizeof m->superposition_reason,
                      "misfit below %.1f %% (lack of fit p %s)",
                      round_up_percent(lack->misfit_high), format_probability(lack->p).text);
    }
}
