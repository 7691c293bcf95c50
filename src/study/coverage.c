/* Coverage: the case is simulated many times from its own fit, and the trials count how often the
 * stated intervals contain the true values.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/master.h"
#include "dma/rubber.h"
#include "indentation/curve_set.h"
#include "indentation/indent.h"
#include "job/cost.h"
#include "job/inputs.h"
#include "job/random_draws.h"
#include "study/coverage_share.h"
#include "study/parametric_bootstrap.h"
#include "weartrack/study.h"

#include "core/base/param.h"
#include "core/math/normal_quantile.h"
#include "core/math/splitmix64.h"
#include "core/table/table_rows.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

wt_coverage_job wt_coverage_job_defaults(void)
{
    return (wt_coverage_job){.trials = 0};
}

static const wt_param rows[] = {
    {PARAM("coverage", wt_coverage_job, trials, WT_Q_NONE, FROM_TO(0, 100000)), .value = "N",
     .help = "of a case, instead of the budget: how often its intervals hold in N trials drawn "
             "from its own fit"},
};
PARAM_TABLE(wt_coverage_job_params, wt_coverage_job, rows, wt_coverage_job_defaults, NO_PARTS)

/* Numbers whose intervals are tested. The results of a case come first. */
enum { OF_SHIFTS = CASE_QUANTITIES, OF_C1, OF_C2, OF_CURVES, OF_CONTACT, OF_RATIO, N_TESTED };
static const char *tested_name(size_t k)
{
    static const char *const others[N_TESTED] = {[OF_SHIFTS] = "shift factors",
                                                 [OF_C1] = "WLF constant c1",
                                                 [OF_C2] = "WLF constant c2",
                                                 [OF_CURVES] = "moduli of the curves",
                                                 [OF_CONTACT] = "contact points of the curves",
                                                 [OF_RATIO] = "modulus ratio by its spots"};
    return k < CASE_QUANTITIES ? case_quantity_names[k] : others[k];
}

/* Result of one trial of one number: true if the truth is within, as a share for several
 * numbers. */
typedef struct interval_test {
    double one, both, deviation, variance; /* squares of the last two; `one` NaN if no interval
                                              was stated */
} interval_test;

typedef struct coverage {
    const wt_coverage_job *job;
    wt_job work; /* options of one trial */
    case_variant case_variant;
    wt_estimate truth[CASE_QUANTITIES];
    wt_master fit;       /* n_shifts 0 if the material is fixed */
    wt_master layer_fit; /* fit of the layer material, likewise */
    wt_group_data data[2];
    scattered_group group[2];
    bool has_groups, has_curves;
    double log_ratio;
    wt_contact_table *contact[2]; /* of the curves; [2] for bulk and track */
    wt_prony spectrum[2];         /* no terms if there is none */
    curve_scratch **scratch;      /* [n_workers] */
    unsigned n_workers;
    interval_test *hits; /* [trials * N_TESTED] */
} coverage;

static interval_test test_interval(double value, double error, double low, double high,
                                   double truth)
{
    if (!(error > 0) || !isfinite(value) || !isfinite(truth))
        return (interval_test){(double)NAN, (double)NAN, (double)NAN, (double)NAN};
    return (interval_test){fabs(value - truth) <= error, low <= truth && truth <= high,
                           (value - truth) * (value - truth), error * error};
}

static interval_test test_wt_interval(wt_interval x, double truth)
{
    return test_interval(x.value, x.standard_error, x.low, x.high, truth);
}

/* Tests a normal number whose true value is 0. */
static interval_test test_estimate(wt_estimate e)
{
    const double half = NORMAL_95 * e.standard_error;
    return test_interval(e.value, e.standard_error, e.value - half, e.value + half, 0);
}

/* Sum over several numbers of one kind, with their count. */
typedef struct interval_test_sum {
    interval_test of;
    double n;
} interval_test_sum;

static void add_interval_test(interval_test_sum *sum, interval_test h)
{
    if (isnan(h.one))
        return;
    sum->of = (interval_test){sum->of.one + h.one, sum->of.both + h.both,
                              sum->of.deviation + h.deviation, sum->of.variance + h.variance};
    sum->n++;
}

static interval_test mean_interval_test(interval_test_sum sum)
{
    return (interval_test){sum.of.one / sum.n, sum.of.both / sum.n, sum.of.deviation / sum.n,
                           sum.of.variance / sum.n};
}

/* True if the groups of a trial determine its friction. */
static bool uses_group_ratio(const coverage *c)
{
    return c->has_groups && c->job->ratio_of_groups && c->case_variant.has_known &&
           c->case_variant.known.modulus_ratio.standard_error > 0;
}

/* ---- one trial ------------------------------------------------------------------------------- */

static interval_test test_shifts(const wt_master *m, const double *truth)
{
    interval_test_sum sum = {0};
    for (size_t k = 0; k < m->n_shifts; k++)
        add_interval_test(&sum, test_wt_interval(m->shifts[k].log_a, truth[k]));
    return mean_interval_test(sum);
}

/* Tests the shifts and the shift law of a trial. */
static void test_shift_law(const wt_master *fit, const wt_master *truth, const double *shift,
                           interval_test *hits)
{
    if (fit->n_shifts == truth->n_shifts)
        hits[OF_SHIFTS] = test_shifts(fit, shift);
    if (fit->law.kind == WT_LAW_WLF && truth->law.kind == WT_LAW_WLF) {
        hits[OF_C1] = test_wt_interval(fit->c1, truth->c1.value);
        hits[OF_C2] = test_wt_interval(fit->c2, truth->c2.value);
    }
}

/* Simulates isotherms and fits them with the options of the case. hits: NULL for the material of
 * the layer. */
static wt_status refit_material(const coverage *c, const wt_rubber *own, const wt_master *truth,
                                uint64_t seed, wt_rubber *rubber, interval_test *hits,
                                wt_error *err)
{
    wt_sweep sweep = {0};
    wt_master fit = {0};
    double *shift = malloc((truth->n_shifts + 1) * sizeof *shift);
    wt_status status = shift == NULL
                           ? wt_fail(err, WT_E_MEMORY, "out of memory")
                           : bootstrap_sweep(&own->sweep, truth, seed, &sweep, shift, err);
    if (status == WT_OK)
        status = flow_rubber_fit(&sweep, &own->fit, own->poisson_ratio, FLOW_STORED_DRAWS, &c->work,
                                 &fit, rubber, err);
    if (status == WT_OK && hits != NULL)
        test_shift_law(&fit, truth, shift, hits);
    if (status == WT_OK) {
        rubber->is_transverse = own->is_transverse;
        rubber->transverse = own->transverse;
    }
    wt_sweep_clear(&sweep);
    wt_master_clear(&fit);
    free(shift);
    return status;
}

/* Simulates the materials of a trial. A material without isotherms stays fixed. */
static wt_status refit_materials(const coverage *c, uint64_t seed, case_variant *s, wt_rubber *bulk,
                                 wt_rubber *layer, interval_test *hits, wt_error *err)
{
    wt_status status = WT_OK;
    if (c->fit.n_shifts > 0) {
        status = refit_material(c, &c->case_variant.rubber, &c->fit, seed, bulk, hits, err);
        s->rubber = *bulk;
        s->given = NULL;
    }
    if (status == WT_OK && c->layer_fit.n_shifts > 0) {
        status = refit_material(c, &c->case_variant.layer_rubber, &c->layer_fit, splitmix64(seed),
                                layer, NULL, err);
        s->layer_rubber = *layer;
    }
    return status;
}

/* Simulates the force curves of a group about scattering moduli and fits them with the spectrum of
 * the trial. Moduli of accepted curves are stored contiguously. */
static wt_status refit_curves(const coverage *c, unsigned g, const wt_rubber *rubber, uint64_t seed,
                              unsigned worker, double *modulus, long *spot, size_t *n,
                              interval_test_sum *sums, wt_error *err)
{
    const wt_curve_set *set = c->job->curves[g];
    const bool known = c->spectrum[g].n > 0;
    wt_prony own = {0};
    char ignored[256];
    wt_status status = WT_OK;
    size_t accepted = 0;
    if (known && rubber != NULL)
        status = flow_rubber_spectrum(rubber, curve_set_temperature(set), &own, ignored, err);
    const wt_prony *fitted = !known ? NULL : rubber != NULL ? &own : &c->spectrum[g];
    for (size_t i = 0; i < *n && status == WT_OK; i++) {
        simulated_fit again;
        status = curve_set_simulate_fit(set, i, modulus[i], known ? &c->spectrum[g] : NULL, fitted,
                                        c->contact[g], splitmix64(seed + g), c->scratch[worker],
                                        &again, err);
        if (status != WT_OK || !again.accepted)
            continue;
        add_interval_test(&sums[OF_CURVES], test_estimate(again.log_level));
        add_interval_test(&sums[OF_CONTACT], test_estimate(again.contact_point));
        modulus[accepted] = again.level;
        spot[accepted++] = c->group[g].spot[i];
    }
    wt_prony_clear(&own);
    *n = accepted;
    return status;
}

/* rubber: material of the trial; NULL if it is fixed. */
static wt_status run_group_trial(const coverage *c, const wt_rubber *rubber, uint64_t seed,
                                 unsigned worker, interval_test *hits, wt_comparison *comparison,
                                 wt_error *err)
{
    wt_group group[2];
    wt_comparison found;
    interval_test_sum sums[N_TESTED] = {0};
    const size_t n[2] = {c->group[0].n, c->group[1].n};
    double *modulus = malloc((n[0] + n[1]) * sizeof *modulus);
    long *spot = malloc((n[0] + n[1]) * sizeof *spot);
    wt_status status =
        modulus == NULL || spot == NULL ? wt_fail(err, WT_E_MEMORY, "out of memory") : WT_OK;
    for (unsigned g = 0; g < 2 && status == WT_OK; g++) {
        double *own = modulus + (g == 0 ? 0 : n[0]);
        long *of = spot + (g == 0 ? 0 : n[0]);
        bootstrap_group(&c->group[g], seed, g, own);
        group[g] = (wt_group){.modulus = own, .spot = c->group[g].spot, .n = n[g]};
        if (!c->has_curves)
            continue;
        status = refit_curves(c, g, rubber, seed, worker, own, of, &group[g].n, sums, err);
        group[g].spot = of;
    }
    for (int k = OF_CURVES; k <= OF_CONTACT && status == WT_OK && c->has_curves; k++)
        hits[k] = mean_interval_test(sums[k]);
    if (status == WT_OK)
        status = wt_compare_moduli(&group[0], &group[1], NULL, &found, err);
    if (status == WT_OK)
        hits[OF_RATIO] = test_interval(found.log_ratio.value, found.log_ratio.standard_error,
                                       log(found.ratio_low), log(found.ratio_high), c->log_ratio);
    if (status == WT_OK)
        *comparison = found;
    free(modulus);
    free(spot);
    return status;
}

/* Sets the modulus ratio of the friction with the layer to that of the trial: its spots, and a
 * calibration error drawn anew. */
static void set_trial_ratio(const coverage *c, const wt_comparison *found, uint64_t seed,
                            case_variant *s)
{
    const wt_layer_observation *truth = &c->case_variant.known;
    const double error = truth->modulus_ratio.standard_error / truth->modulus_ratio.value;
    const double calibration = sqrt(truth->calibration_share) * error;
    const double off = found->log_ratio.value - c->log_ratio +
                       calibration * flow_draw_normal(seed, 0, FLOW_DRAW_RATIO);
    const double spread = hypot(found->log_ratio.standard_error, calibration);
    wt_layer_observation *known = &s->known;
    known->modulus_ratio.value = truth->modulus_ratio.value * exp(off);
    known->modulus_ratio.standard_error = spread * known->modulus_ratio.value;
    known->calibration_share = pow(calibration / spread, 2);
    if (!(calibration > 0)) /* otherwise both contribute, as in the case */
        known->modulus_ratio_df = found->df;
}

static wt_status run_trial(const coverage *c, size_t trial, unsigned worker, interval_test *hits,
                           wt_error *err)
{
    const uint64_t seed = splitmix64(splitmix64(c->work.seed) + 1 + trial);
    wt_estimate number[CASE_QUANTITIES];
    wt_comparison found = {.df = (double)NAN}; /* no ratio is used without groups */
    wt_rubber rubber = {0}, layer = {0};
    wt_job work = c->work;
    case_variant s = c->case_variant;
    work.seed += 1 + trial;
    for (size_t k = 0; k < CASE_QUANTITIES; k++)
        number[k] = (wt_estimate){(double)NAN, (double)NAN, (double)NAN, NULL};
    wt_status status = refit_materials(c, seed, &s, &rubber, &layer, hits, err);
    bootstrap_inputs(&s, seed);
    if (status == WT_OK && c->has_groups)
        status = run_group_trial(c, c->fit.n_shifts > 0 ? &rubber : NULL, seed, worker, hits,
                                 &found, err);
    if (status == WT_OK && uses_group_ratio(c))
        set_trial_ratio(c, &found, seed, &s);
    if (status == WT_OK)
        status = case_variant_compute(&s, &work, number, err);
    for (size_t k = 0; k < CASE_QUANTITIES && status == WT_OK; k++) {
        const double half = NORMAL_95 * number[k].standard_error;
        hits[k] = test_interval(number[k].value, number[k].standard_error, number[k].value - half,
                                number[k].value + half, c->truth[k].value);
    }
    wt_rubber_clear(&rubber);
    wt_rubber_clear(&layer);
    return status;
}

/* A trial without a result does not count. */
static wt_status run_trial_task(void *user, size_t trial, unsigned worker)
{
    const coverage *c = user;
    interval_test *hits = c->hits + trial * N_TESTED;
    wt_error ignored = WT_ERROR_INIT;
    const wt_status status = run_trial(c, trial, worker, hits, &ignored);
    for (size_t k = 0; status != WT_OK && k < N_TESTED; k++)
        hits[k].one = (double)NAN;
    return status == WT_E_MEMORY ? status : WT_OK;
}

/* ---- table ----------------------------------------------------------------------------------- */

typedef struct coverage_count {
    size_t n;
    double one, both, scatter;
    coverage_share known;
} coverage_count;

TABLE_ROW(coverage, COVERAGE, const char *number; coverage_count found;)

static coverage_count count_interval_tests(const coverage *c, size_t k)
{
    coverage_count t = {.scatter = (double)NAN};
    double deviation = 0, variance = 0;
    for (size_t i = 0; i < c->job->trials; i++) {
        const interval_test *h = &c->hits[i * N_TESTED + k];
        if (isnan(h->one))
            continue;
        t.n++;
        t.one += h->one;
        t.both += h->both;
        deviation += h->deviation;
        variance += h->variance;
    }
    if (t.n == 0)
        return t;
    t.one /= (double)t.n;
    t.both /= (double)t.n;
    t.scatter = sqrt(deviation / variance);
    t.known = coverage_assess(t.both, t.n);
    return t;
}

static size_t count_failed_trials(const coverage *c)
{
    size_t n = 0;
    for (size_t i = 0; i < c->job->trials; i++) {
        size_t stated = 0;
        for (size_t k = 0; k < N_TESTED; k++)
            stated += isnan(c->hits[i * N_TESTED + k].one) == 0;
        n += stated == 0;
    }
    return n;
}

/* Lists all numbers with their shares, or those of one verdict. */
static void list_shares(const coverage *c, const char *verdict, char *text, size_t size)
{
    size_t n = 0;
    text[0] = '\0';
    for (size_t k = 0; k < N_TESTED && n < size; k++) {
        const coverage_count found = count_interval_tests(c, k);
        if (found.n == 0 || (verdict != NULL && strcmp(found.known.verdict, verdict) != 0))
            continue;
        n += (size_t)snprintf(text + n, size - n, "%s%s", n > 0 ? ", " : "", tested_name(k));
        if (verdict == NULL && n < size)
            n += (size_t)snprintf(text + n, size - n, " %.0f %%", 100 * found.both);
        else if (!isnan(found.known.trials) && n < size)
            n += (size_t)snprintf(text + n, size - n, " (%.0f trials would tell)",
                                  found.known.trials);
    }
}

static void set_verdict_keys(const coverage *c, table_writer *t)
{
    char all[400], narrow[300], wide[300], unsettled[600], inputs[300];
    list_shares(c, NULL, all, sizeof all);
    list_shares(c, "too narrow", narrow, sizeof narrow);
    list_shares(c, "too wide", wide, sizeof wide);
    list_shares(c, "cannot say", unsettled, sizeof unsettled);
    case_variant drawn = c->case_variant;
    if (uses_group_ratio(c))
        drawn.known.modulus_ratio.standard_error = 0;
    bootstrap_describe(&drawn, inputs, sizeof inputs);
    coverage_set_print(
        t, COVERAGE_KEY_ANSWER,
        "in %zu trial%s the 95 %% intervals held the truth: %s%s%s%s%s%s%s%s", c->job->trials,
        c->job->trials == 1 ? "" : "s", all[0] != '\0' ? all : "none was stated",
        narrow[0] != '\0' ? "; too narrow: " : "", narrow, wide[0] != '\0' ? "; too wide: " : "",
        wide, unsettled[0] != '\0' ? "; cannot say: " : "", unsettled,
        narrow[0] == '\0' && wide[0] == '\0' && unsettled[0] == '\0' && all[0] != '\0'
            ? "; as far as so many tell, as often as stated"
            : "");
    coverage_set_print(t, COVERAGE_KEY_REGENERATED, "%s%s%s%s%s%s",
                       c->fit.n_shifts == 0 ? "material as given"
                       : c->case_variant.rubber.sweep.n_ramps > 0
                           ? "isotherms that the temperature sweeps were fitted as"
                           : "isotherms of the DMA",
                       !drawn.has_known || !drawn.has_layer_rubber ? ""
                       : c->layer_fit.n_shifts > 0 ? ", isotherms of the layer's DMA"
                                                   : ", material of the layer as given",
                       inputs[0] != '\0' ? ", " : "", inputs,
                       !c->has_groups  ? ""
                       : c->has_curves ? ", force curves of bulk and track"
                                       : ", moduli of bulk and track",
                       c->has_groups && !uses_group_ratio(c) ? " (not in the friction)" : "");
    coverage_set_text(t, COVERAGE_KEY_CAUTION,
                      "the case was drawn anew from its own fit and judged with the same model: "
                      "this tells whether the errors are reckoned right and cannot reveal a wrong "
                      "model, such as a wrong tip, roughness or law of friction; the table what_if "
                      "has what the choices of the model do");
}

static wt_status make_coverage_table(const coverage *c, wt_table **table, wt_error *err)
{
    table_writer t = table_begin(&coverage_schema, err);
    for (size_t k = 0; k < N_TESTED; k++) {
        const coverage_count found = count_interval_tests(c, k);
        if (found.n > 0)
            TABLE_ADD(coverage, &t, tested_name(k), found);
    }
    set_verdict_keys(c, &t);
    coverage_set_value(&t, COVERAGE_KEY_TRIALS, (double)c->job->trials, (double)NAN, (double)NAN);
    coverage_set_value(&t, COVERAGE_KEY_LOST, (double)count_failed_trials(c), (double)NAN,
                       (double)NAN);
    return table_end(&t, table);
}

/* ---- job ------------------------------------------------------------------------------------- */

/* Reads the groups as they were compared: factors on the spectrum if all curves have one. */
static wt_status find_scattered_groups(coverage *c, wt_error *err)
{
    const wt_table *const tables[2] = {c->job->bulk, c->job->track};
    bool factors = true;
    wt_group group[2];
    wt_comparison found;
    if (tables[0] == NULL || tables[1] == NULL)
        return WT_OK;
    for (int g = 0; g < 2; g++) {
        const wt_status status = wt_group_from_table(tables[g], false, &c->data[g], err);
        if (status != WT_OK)
            return status;
        for (size_t i = 0; i < c->data[g].group.n; i++)
            factors = factors && c->data[g].spectrum_factor[i] > 0;
    }
    c->has_groups = c->has_curves = true;
    for (int g = 0; g < 2; g++) {
        const wt_curve_set *set = c->job->curves[g];
        const size_t n = curve_set_size(set);
        if (n == 0 || n != c->data[g].group.n || curve_set_has_spectrum(set) != factors)
            c->has_curves = false;
    }
    for (int g = 0; g < 2; g++) {
        const wt_group_data *d = &c->data[g];
        const double *of = factors ? d->spectrum_factor : d->modulus;
        const double error = c->has_curves ? curve_set_variance(c->job->curves[g]) : 0;
        c->has_groups =
            bootstrap_scatter(of, d->spot, d->group.n, error, &c->group[g]) && c->has_groups;
        group[g] = (wt_group){.modulus = of, .spot = d->spot, .n = d->group.n};
    }
    if (c->has_groups && wt_compare_moduli(&group[0], &group[1], NULL, &found, NULL) == WT_OK)
        c->log_ratio = found.log_ratio.value;
    else
        c->has_groups = false;
    return WT_OK;
}

/* Prepares contact tables, spectra and scratch memory of the curves. */
static wt_status prepare_curves(coverage *c, unsigned threads, wt_error *err)
{
    char ignored[256];
    wt_status status = WT_OK;
    c->has_curves = c->has_curves && c->has_groups;
    if (!c->has_curves)
        return WT_OK;
    for (int g = 0; g < 2 && status == WT_OK; g++) {
        const wt_curve_set *set = c->job->curves[g];
        status = indent_contact_table(curve_set_tip(set), &c->contact[g], err);
        if (status == WT_OK && curve_set_has_spectrum(set))
            status = flow_rubber_spectrum(&c->case_variant.rubber, curve_set_temperature(set),
                                          &c->spectrum[g], ignored, err);
    }
    c->n_workers = wt_thread_count(threads);
    c->scratch = status == WT_OK ? calloc(c->n_workers, sizeof(curve_scratch *)) : NULL;
    for (unsigned i = 0; i < c->n_workers && c->scratch != NULL && status == WT_OK; i++)
        if ((c->scratch[i] = curve_scratch_new(c->job->curves)) == NULL)
            status = wt_fail(err, WT_E_MEMORY, "out of memory");
    return status == WT_OK && c->scratch == NULL ? wt_fail(err, WT_E_MEMORY, "out of memory")
                                                 : status;
}

/* Fits the isotherms that a material is simulated from. Without isotherms the fit stays empty. */
static wt_status fit_isotherms(const wt_rubber *rubber, wt_master *fit, wt_error *err)
{
    return rubber->kind == WT_RUBBER_SERIES && rubber->sweep.n_isotherms > 0
               ? wt_master_fit(&rubber->sweep, &rubber->fit, NULL, fit, err)
               : WT_OK;
}

/* A layer material without isotherms is fixed. */
static wt_status prepare_layer_rubber(coverage *c, wt_error *err)
{
    wt_rubber *const rubber = &c->case_variant.layer_rubber;
    const wt_status status = c->case_variant.has_layer_rubber && c->case_variant.has_known
                                 ? fit_isotherms(rubber, &c->layer_fit, err)
                                 : WT_OK;
    if (status == WT_OK && c->layer_fit.n_shifts == 0) {
        rubber->n_draws = 0;
        rubber->c1_error = rubber->c2_error = 0;
    }
    return status;
}

/* Computes the results of the case as stated, which are the true values of the trials. */
static wt_status set_truth(coverage *c, const wt_job *work, wt_error *err)
{
    const wt_coverage_job *job = c->job;
    wt_status status =
        case_variant_create(job->sliding, job->layer, job->known, work, &c->case_variant, err);
    if (status != WT_OK)
        return status;
    /* fixed: strain sweeps are not simulated */
    c->case_variant.softness.storage_error = c->case_variant.softness.loss_error = NULL;
    c->work = *work;
    c->work.threads = 1; /* the trials use the threads */
    c->work.left_out =
        work->replicates < 2 ? WT_EXTRA_ALL : WT_EXTRA_ALL & ~(unsigned)WT_EXTRA_DRAWS;
    c->work.drawn = NULL; /* the stored draws are for another material */
    c->work.log = NULL;
    c->work.progress = (wt_progress){0};
    status = fit_isotherms(&c->case_variant.rubber, &c->fit, err);
    if (status == WT_OK)
        status = prepare_layer_rubber(c, err);
    if (status == WT_OK)
        status = find_scattered_groups(c, err);
    if (status == WT_OK)
        status = prepare_curves(c, work->threads, err);
    for (size_t k = 0; k < CASE_QUANTITIES; k++)
        c->truth[k] = (wt_estimate){(double)NAN, (double)NAN, (double)NAN, NULL};
    wt_job plain = c->work;
    plain.replicates = 0;
    return status == WT_OK ? case_variant_compute(&c->case_variant, &plain, c->truth, err) : status;
}

wt_status wt_coverage_compute(const wt_coverage_job *job, const wt_job *work, wt_table **table,
                              wt_error *err)
{
    if (job == NULL || work == NULL || table == NULL || job->trials == 0)
        return wt_fail(err, WT_E_ARG, "no coverage to count");
    coverage c = {.job = job};
    wt_status status = param_check(wt_coverage_job_params(), job, err);
    if (status == WT_OK)
        status = set_truth(&c, work, err);
    if (status == WT_OK) {
        c.hits = malloc(job->trials * N_TESTED * sizeof *c.hits);
        for (size_t i = 0; c.hits != NULL && i < job->trials * N_TESTED; i++)
            c.hits[i].one = (double)NAN;
        status = c.hits == NULL ? wt_fail(err, WT_E_MEMORY, "out of memory")
                                : wt_parallel_for(job->trials, work->threads, run_trial_task, &c,
                                                  &work->progress, "coverage");
    }
    if (status == WT_OK)
        status = make_coverage_table(&c, table, err);
    cost_report(work, (cost_summary){.items = (double)job->trials});
    for (unsigned i = 0; i < c.n_workers && c.scratch != NULL; i++)
        curve_scratch_free(c.scratch[i]);
    free(c.scratch);
    for (int g = 0; g < 2; g++) {
        wt_group_data_clear(&c.data[g]);
        wt_contact_table_free(c.contact[g]);
        wt_prony_clear(&c.spectrum[g]);
    }
    wt_master_clear(&c.fit);
    wt_master_clear(&c.layer_fit);
    free(c.hits);
    return status;
}
