/* The DMA job on sweeps of a known rubber, and the rubber at another temperature: every column of
 * the tables against the series and the law of the sweeps.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "truth_fixture.h"

#include "dma_data.h"
#include "weartrack/dma.h"

enum { ISOTHERMS = 11, POINTS = 16 };

#define REFERENCE 293.15
#define NOISE 0.003

static char path[] = "/tmp/weartrack-dma-XXXXXX";
static wt_formats *formats;
static wt_master_tables tables;
static wt_rubber rubber;

static double temperature_of(size_t i)
{
    return 253.15 + 10.0 * (double)i;
}

static double true_log_a(double temperature)
{
    double step = temperature - REFERENCE;
    return -8.0 * step / (110.0 + step);
}

/* Minimum overlap of isotherm i towards the reference [decade]. */
static double true_overlap(size_t i)
{
    double least = (double)INFINITY;
    for (size_t k = i; fabs(temperature_of(k) - REFERENCE) > 1;) {
        const size_t next = temperature_of(k) < REFERENCE ? k + 1 : k - 1;
        least =
            fmin(least, 3 - fabs(true_log_a(temperature_of(k)) - true_log_a(temperature_of(next))));
        k = next;
    }
    return least;
}

/* E' and E'' in tension from -20 to 80 degC, proportional to rho T: b = T0/T. */
static int make(void **state)
{
    (void)state;
    const char *const patterns[] = {path};
    wt_file_set set = {.patterns = patterns, .n_patterns = 1, .read = wt_read_defaults()};
    wt_master_job job = wt_master_job_defaults();
    wt_job common = wt_job_defaults();
    wt_error err = WT_ERROR_INIT;
    uint64_t seed = 5;
    FILE *out = truth_file(path);
    fputs("## table: sweep\n# angular_frequency[rad/s]\tstorage_modulus[Pa]\tloss_modulus[Pa]\t"
          "temperature[K]\n",
          out);
    for (size_t i = 0; i < ISOTHERMS; i++) {
        double t = temperature_of(i);
        for (int k = 0; k < POINTS; k++) {
            double omega = pow(10, -1 + 3.0 * k / (POINTS - 1)), storage, loss;
            dma_moduli(&dma_rubber, omega * pow(10, true_log_a(t)), &storage, &loss);
            storage *= t / REFERENCE * exp(NOISE * truth_normal(&seed));
            loss *= t / REFERENCE * exp(NOISE * truth_normal(&seed));
            fprintf(out, "%.17g\t%.17g\t%.17g\t%.17g\n", omega, storage, loss, t);
        }
        fputs(i + 1 < ISOTHERMS ? "\n" : "##\n", out);
    }
    fclose(out);
    if (wt_formats_new(NULL, &formats, NULL, NULL) != WT_OK)
        return -1;
    common.formats = formats;
    job.sets = &set;
    job.n_sets = 1;
    job.fit.reference_temperature = REFERENCE;
    job.fit.sample_temperature_error = 0; /* the temperatures are true */
    job.poisson_ratio = 0.45;
    if (wt_master_compute(&job, &common, &tables, &rubber, &err) == WT_OK)
        return 0;
    print_error("%s: %s %s\n", err.place, err.message, err.found);
    return -1;
}

static int clean(void **state)
{
    (void)state;
    wt_master_tables_clear(&tables);
    wt_rubber_clear(&rubber);
    wt_formats_free(formats);
    unlink(path);
    return 0;
}

/* ---- tables ---------------------------------------------------------------------------------- */

static void test_shift_factors(void **state)
{
    (void)state;
    const wt_table *t = tables.shift_factors;
    assert_int_equal(tables.n_isotherms, ISOTHERMS);
    assert_int_equal(wt_table_n_rows(t), ISOTHERMS);
    for (size_t i = 0; i < ISOTHERMS; i++) {
        double at = temperature_of(i), se_a = cell(t, i, "log_a_standard_error");
        double se_b = cell(t, i, "log_b_standard_error");
        assert_near(cell(t, i, "temperature"), at, 1e-9);
        assert_near_abs(cell(t, i, "log_a"), true_log_a(at), 0.05);
        assert_near_abs(cell(t, i, "log_b"), -log10(at / REFERENCE), 0.02);
        assert_near_abs(cell(t, i, "log_b_physical"), -log10(at / REFERENCE), 1e-9);
        assert_near_abs(cell(t, i, "law_log_a"), true_log_a(at), 0.02);
        assert_true(cell(t, i, "law_log_a_low") <= cell(t, i, "law_log_a"));
        assert_true(cell(t, i, "law_log_a_high") >= cell(t, i, "law_log_a"));
        assert_near_abs(cell(t, i, "log_b_material"), -log10(at / REFERENCE), 0.01);
        assert_near(cell(t, i, "determined"), 1, 0);
        bool reference = fabs(at - REFERENCE) < 1;
        assert_true(reference ? se_a == 0 : se_a > 1e-5 && se_a < 0.1);
        assert_true(se_b > 1e-5 && se_b < 0.05);
        assert_near_abs(cell(t, i, "log_a_low"), cell(t, i, "log_a") - 1.96 * se_a, 0.3 * se_a);
        assert_near_abs(cell(t, i, "log_a_high"), cell(t, i, "log_a") + 1.96 * se_a, 0.3 * se_a);
        if (!reference)
            assert_near_abs(cell(t, i, "overlap"), true_overlap(i), 0.05);
        assert_true(cell(t, i, "noise_factor") > 0.5 && cell(t, i, "noise_factor") < 2);
        assert_near(cell(t, i, "outliers"), 0, 0);
    }
}

static void test_law(void **state)
{
    (void)state;
    const wt_table *t = tables.shift_factors;
    wt_estimate c1 = key_estimate(t, "wlf_c1"), c2 = key_estimate(t, "wlf_c2");
    wt_estimate slope = key_estimate(t, "law_slope"), pole = key_estimate(t, "pole");
    assert_near(c1.value, 8, 0.02);
    assert_near(c2.value, 110, 0.02);
    assert_true(c1.standard_error > 0 && c1.standard_error < 0.5);
    assert_true(c2.standard_error > 10 * c1.standard_error && c2.standard_error < 5);
    assert_near(slope.value, -c1.value / c2.value, 1e-6);
    assert_true(slope.standard_error > 0);
    assert_near(pole.value, REFERENCE - c2.value, 1e-9);
    assert_near(pole.standard_error, c2.standard_error, 1e-9);
    assert_true(atof(wt_table_key(t, "wlf_correlation")) > 0.5);
    assert_string_equal(wt_table_key(t, "law"), "WLF");
    assert_true(key_estimate(t, "law_rms").value < 0.03);
    assert_true(fabs(key_estimate(t, "offset").value) < 0.03);
    assert_true(key_estimate(t, "temperature_spread").value < 0.5);
    assert_near(key_estimate(t, "reference_temperature").value, REFERENCE, 0);
    assert_string_equal(wt_table_key(t, "vertical"), "tied");
    assert_string_equal(wt_table_key(t, "deformation"), "tension");
    /* Chance causes a lack of fit in one draw of a hundred: the verdict is then "inconclusive". */
    assert_int_not_equal(strncmp(wt_table_key(t, "superposition"), "fails", 5), 0);
    assert_true(atof(wt_table_key(t, "misfit_high")) < 0.002);
}

/* The loss modulus differs much from the storage modulus, so that an exchange is detected. */
static void test_master_curve(void **state)
{
    (void)state;
    const wt_table *t = tables.master_curve;
    assert_int_equal(wt_table_n_rows(t), ISOTHERMS * POINTS);
    for (size_t i = 0; i < ISOTHERMS * POINTS; i++) {
        double at = temperature_of(i / POINTS), storage, loss;
        double omega = pow(10, -1 + 3.0 * (double)(i % POINTS) / (POINTS - 1) + true_log_a(at));
        dma_moduli(&dma_rubber, omega, &storage, &loss);
        assert_near(cell(t, i, "temperature"), at, 1e-9);
        assert_near(cell(t, i, "angular_frequency"), omega, 0.12);
        assert_near(cell(t, i, "storage_modulus"), storage, 0.06);
        assert_near(cell(t, i, "loss_modulus"), loss, 0.06);
        assert_near(cell(t, i, "fitted_storage"), storage, 0.02);
        assert_near(cell(t, i, "fitted_loss"), loss, 0.03);
        assert_true(cell(t, i, "fitted_storage_low") < cell(t, i, "fitted_storage"));
        assert_true(cell(t, i, "fitted_storage_high") > cell(t, i, "fitted_storage"));
        assert_true(cell(t, i, "fitted_loss_low") < cell(t, i, "fitted_loss"));
        assert_true(cell(t, i, "fitted_loss_high") > cell(t, i, "fitted_loss"));
        assert_near(cell(t, i, "left_out"), 0, 0);
        assert_near(cell(t, i, "fitted_loss_factor"), loss / storage, 0.03);
        assert_near(cell(t, i, "fitted_loss_factor"),
                    cell(t, i, "fitted_loss") / cell(t, i, "fitted_storage"), 1e-6);
        assert_true(cell(t, i, "fitted_loss_factor_low") < cell(t, i, "fitted_loss_factor"));
        assert_true(cell(t, i, "fitted_loss_factor_high") > cell(t, i, "fitted_loss_factor"));
        /* as measured, whatever the shifts are */
        assert_near(cell(t, i, "own_frequency"),
                    pow(10, -1 + 3.0 * (double)(i % POINTS) / (POINTS - 1)), 1e-9);
        assert_near(cell(t, i, "own_storage"), storage * at / REFERENCE, 5 * NOISE);
        assert_near(cell(t, i, "own_loss"), loss * at / REFERENCE, 5 * NOISE);
        assert_int_equal(wt_table_block(t, i), i / POINTS);
    }
    assert_near(atof(wt_table_key(t, "noise_storage")), NOISE, 0.2);
    assert_near(atof(wt_table_key(t, "noise_loss")), NOISE, 0.2);
    assert_true(atof(wt_table_key(t, "noise_correlation")) < 0.3);
    assert_near(key_estimate(t, "reference_temperature").value, REFERENCE, 0);
}

static void test_prony(void **state)
{
    (void)state;
    const wt_table *t = tables.prony;
    for (double log_omega = -3; log_omega < 5; log_omega += 0.5) {
        double omega = pow(10, log_omega), truth[2];
        double sum[2] = {key_estimate(t, "equilibrium_modulus").value, 0};
        for (size_t i = 0; i < wt_table_n_rows(t); i++) {
            double z = omega * cell(t, i, "relaxation_time"), m = cell(t, i, "modulus");
            sum[0] += m * z * z / (1 + z * z);
            sum[1] += m * z / (1 + z * z);
        }
        dma_moduli(&dma_rubber, omega, &truth[0], &truth[1]);
        assert_near(sum[0], truth[0], 0.02);
        assert_near(sum[1], truth[1], 0.04);
    }
    double first = pow(10, -1 + true_log_a(temperature_of(ISOTHERMS - 1)));
    double last = pow(10, 2 + true_log_a(temperature_of(0)));
    assert_near(key_estimate(t, "frequency_min").value, first, 0.12);
    assert_near(key_estimate(t, "frequency_max").value, last, 0.12);
    assert_near(key_estimate(t, "reference_temperature").value, REFERENCE, 0);
    assert_string_equal(wt_table_key(t, "deformation"), "tension");
}

/* ---- relations of the tables ----------------------------------------------------------------- */

/* Points, shifts, law and series are from one fit: each follows from the others. */
static void test_relations(void **state)
{
    (void)state;
    const wt_table *shifts = tables.shift_factors, *curve = tables.master_curve,
                   *prony = tables.prony;
    const double c1 = key_estimate(shifts, "wlf_c1").value,
                 c2 = key_estimate(shifts, "wlf_c2").value,
                 offset = key_estimate(shifts, "offset").value;
    double squares = 0, lowest = (double)INFINITY, highest = 0, on_band = 0;
    for (size_t i = 0; i < ISOTHERMS; i++) {
        const double step = cell(shifts, i, "temperature") - REFERENCE,
                     law = -c1 * step / (c2 + step), off = cell(shifts, i, "log_a") - offset - law;
        assert_near_abs(cell(shifts, i, "law_log_a"), law, 2e-3);
        assert_near(cell(shifts, i, "log_a") -
                        1.959963985 * cell(shifts, i, "log_a_standard_error"),
                    cell(shifts, i, "log_a_low"), 0.02);
        squares += off * off;
    }
    assert_near(key_estimate(shifts, "law_rms").value, sqrt(squares / ISOTHERMS), 1e-6);
    for (size_t row = 0; row < wt_table_n_rows(curve); row++) {
        const double omega = cell(curve, row, "angular_frequency");
        size_t i = 0;
        while (fabs(cell(shifts, i, "temperature") - cell(curve, row, "temperature")) > 1e-6)
            i++;
        const double a = cell(shifts, i, "log_a") - offset, b = cell(shifts, i, "log_b");
        assert_near(omega, cell(curve, row, "own_frequency") * pow(10, a), 1e-9);
        assert_near(cell(curve, row, "storage_modulus"),
                    cell(curve, row, "own_storage") * pow(10, b), 1e-9);
        assert_near(cell(curve, row, "loss_modulus"), cell(curve, row, "own_loss") * pow(10, b),
                    1e-9);
        assert_near(cell(curve, row, "loss_factor"),
                    cell(curve, row, "own_loss") / cell(curve, row, "own_storage"), 1e-9);
        double sum[2] = {key_estimate(prony, "equilibrium_modulus").value, 0};
        for (size_t k = 0; k < wt_table_n_rows(prony); k++) {
            const double z = omega * cell(prony, k, "relaxation_time"),
                         m = cell(prony, k, "modulus");
            sum[0] += m * z * z / (1 + z * z);
            sum[1] += m * z / (1 + z * z);
        }
        assert_near(cell(curve, row, "fitted_storage"), sum[0], 3e-3);
        assert_near(cell(curve, row, "fitted_loss"), sum[1], 3e-3);
        static const char *const fitted[] = {"fitted_storage", "fitted_loss", "fitted_loss_factor"};
        /* symmetric in the logarithm, and small enough to be useful */
        for (size_t q = 0; q < 3; q++) {
            char low[40], high[40];
            snprintf(low, sizeof low, "%s_low", fitted[q]);
            snprintf(high, sizeof high, "%s_high", fitted[q]);
            const double up = log(cell(curve, row, high) / cell(curve, row, fitted[q])),
                         down = log(cell(curve, row, fitted[q]) / cell(curve, row, low));
            assert_near(up, down, 0.4);
            assert_true(up > 1e-4 && up < 0.1);
            on_band += up;
        }
        lowest = fmin(lowest, omega);
        highest = fmax(highest, omega);
    }
    assert_true(on_band / (3.0 * ISOTHERMS * POINTS) < 0.02);
    assert_near(key_estimate(prony, "frequency_min").value, lowest, 1e-9);
    assert_near(key_estimate(prony, "frequency_max").value, highest, 1e-9);
    assert_near(atof(wt_table_key(prony, "rms_storage")), NOISE, 0.2);
    assert_near(atof(wt_table_key(prony, "rms_loss")), NOISE, 0.2);
    for (size_t k = 0; k + 1 < wt_table_n_rows(prony); k++)
        assert_near(cell(prony, k + 1, "relaxation_time") / cell(prony, k, "relaxation_time"),
                    cell(prony, 1, "relaxation_time") / cell(prony, 0, "relaxation_time"), 1e-6);
}

/* The density is that of the series, a term over its width in ln tau, within the measured range. */
static void test_relaxation_spectrum(void **state)
{
    (void)state;
    const wt_table *prony = tables.prony, *t = tables.relaxation_spectrum;
    const double width = log(cell(prony, 1, "relaxation_time") / cell(prony, 0, "relaxation_time"));
    const double first = key_estimate(prony, "frequency_min").value,
                 last = key_estimate(prony, "frequency_max").value;
    size_t row = 0;
    for (size_t k = 0; k < wt_table_n_rows(prony); k++) {
        const double tau = cell(prony, k, "relaxation_time");
        if (tau * first > 1 || tau * last < 1)
            continue;
        const double density = cell(t, row, "density");
        assert_near(cell(t, row, "relaxation_time"), tau, 1e-9);
        assert_near(density, cell(prony, k, "modulus") / width, 0.02);
        assert_true(cell(t, row, "density_low") < density &&
                    cell(t, row, "density_high") > density);
        row++;
    }
    assert_int_equal(row, wt_table_n_rows(t));
    assert_near(key_estimate(t, "reference_temperature").value, REFERENCE, 0);
    assert_string_equal(wt_table_key(t, "deformation"), "tension");
}

/* The scatter of the draws agrees with the errors of the constants. */
static void test_draws(void **state)
{
    (void)state;
    const wt_table *t = tables.material_draws;
    const wt_estimate c[] = {key_estimate(tables.shift_factors, "wlf_c1"),
                             key_estimate(tables.shift_factors, "wlf_c2"),
                             key_estimate(tables.prony, "equilibrium_modulus")};
    static const char *const columns[] = {"wlf_c1", "wlf_c2", "equilibrium_modulus"};
    double sum[3] = {0}, squares[3] = {0}, product = 0, n = 0;
    for (size_t row = 0; row < wt_table_n_rows(t); row++) {
        if (isnan(cell(t, row, "wlf_c1")))
            continue;
        double off[3];
        for (size_t k = 0; k < 3; k++) {
            off[k] = (cell(t, row, columns[k]) - c[k].value) / c[k].standard_error;
            sum[k] += off[k];
            squares[k] += off[k] * off[k];
        }
        product += off[0] * off[1];
        n++;
    }
    assert_near(n, 200, 0);
    for (size_t k = 0; k < 2; k++) {
        assert_near_abs(sum[k] / n, 0, 0.3);
        assert_near(sqrt(squares[k] / n), 1, 0.2);
    }
    if (isfinite(c[2].standard_error))
        assert_near(sqrt(squares[2] / n), 1, 0.3);
    assert_near(product / sqrt(squares[0] * squares[1]),
                atof(wt_table_key(tables.shift_factors, "wlf_correlation")), 0.05);
    /* of the slope, by the derivative of the law at its reference: c1 / c2 */
    const double r1 = c[0].standard_error / c[0].value, r2 = c[1].standard_error / c[1].value,
                 rho = atof(wt_table_key(tables.shift_factors, "wlf_correlation"));
    const wt_estimate slope = key_estimate(tables.shift_factors, "law_slope");
    assert_near(slope.standard_error / fabs(slope.value),
                sqrt(r1 * r1 + r2 * r2 - 2 * rho * r1 * r2), 0.3);
}

/* ---- the rubber ------------------------------------------------------------------------------ */

/* Input of the later stages, also when read from the tables. */
static void test_rubber(void **state)
{
    (void)state;
    wt_rubber again = {0};
    const wt_rubber_tables old = {.prony = tables.prony, .shift_factors = tables.shift_factors};
    assert_int_equal(wt_rubber_from_tables(&old, 0.45, &again, NULL), WT_OK);
    const wt_rubber *const both[2] = {&rubber, &again};
    for (int i = 0; i < 2; i++) {
        const wt_rubber *r = both[i];
        assert_near(r->poisson_ratio, 0.45, 0);
        assert_int_equal(r->law.kind, WT_LAW_WLF);
        assert_near(r->law.wlf.c1, key_estimate(tables.shift_factors, "wlf_c1").value, 1e-9);
        assert_near(r->law.wlf.c2, key_estimate(tables.shift_factors, "wlf_c2").value, 1e-9);
        assert_near(r->temperature_min, temperature_of(0), 1e-9);
        assert_near(r->temperature_max, temperature_of(ISOTHERMS - 1), 1e-9);
        assert_int_equal(r->n_vertical, ISOTHERMS);
        for (size_t k = 0; k < ISOTHERMS; k++) {
            assert_near(r->vertical_temperature[k], temperature_of(k), 1e-9);
            assert_near_abs(r->vertical_log_b[k], -log10(temperature_of(k) / REFERENCE), 0.02);
        }
    }
    assert_true(rubber.n_draws == 200 && again.n_draws == 0);
    assert_near(again.c1_error, key_estimate(tables.shift_factors, "wlf_c1").standard_error, 1e-9);
    assert_near(again.c2_error, key_estimate(tables.shift_factors, "wlf_c2").standard_error, 1e-9);
    assert_true(again.c_correlation > 0.5 && again.c_correlation < 1);
    wt_rubber_clear(&again);
}

/* A rubber of one term with a law, its errors, and their correlation. */
static wt_rubber simple(double *tau, double *term, double correlation)
{
    return (wt_rubber){.prony = {.deformation = WT_TENSION,
                                 .reference_temperature = REFERENCE,
                                 .equilibrium_modulus = 2e6,
                                 .n = 1,
                                 .relaxation_time = tau,
                                 .modulus = term,
                                 .frequency_min = 0.01,
                                 .frequency_max = 1e7},
                       .poisson_ratio = 0.5,
                       .law = {.kind = WT_LAW_WLF, .wlf = {REFERENCE, 6.5, 110}},
                       .c1_error = 0.13,
                       .c2_error = 2.2,
                       .c_correlation = correlation,
                       .temperature_min = 253.15,
                       .temperature_max = 333.15};
}

static void test_at(void **state)
{
    (void)state;
    double tau = 1e-3, term = 6e6, at[2] = {273.15, 313.15}, log_b[2] = {0.1, -0.2};
    static const double steps[] = {-20, 0, 20, 10};
    static const double b[] = {0.1, -0.05, -0.2, -0.125}; /* between the two, linear */
    wt_rubber r = simple(&tau, &term, 0);
    r.n_vertical = 2;
    r.vertical_temperature = at;
    r.vertical_log_b = log_b;
    for (int i = 0; i < 4; i++) {
        double a = pow(10, -6.5 * steps[i] / (110 + steps[i])), scale = pow(10, -b[i]);
        wt_material *m = NULL;
        assert_int_equal(
            wt_rubber_material(&r, REFERENCE + steps[i], 1, WT_NO_REPLICATE, &m, NULL, NULL),
            WT_OK);
        assert_near(m->frequency_min, 0.01 / a, 1e-9);
        assert_near(m->frequency_max, 1e7 / a, 1e-9);
        for (double omega = 1; omega < 1e6; omega *= 31) {
            double z = omega * tau * a, storage, loss;
            m->law->modulus(m, &omega, 1, &storage, &loss);
            assert_near(storage, scale * (2e6 + 6e6 * z * z / (1 + z * z)), 1e-9);
            assert_near(loss, scale * 6e6 * z / (1 + z * z), 1e-9);
        }
        wt_material_free(m);
    }
}

/* Scatter of log10 a over replicates: propagated from c1, c2 and their correlation, whose sign
 * decides whether both errors add or cancel. */
static void test_shift_error(void **state)
{
    (void)state;
    enum { N = 400 };
    static const double correlations[] = {0.9, 0, -0.9}, steps[] = {20, -30};
    double tau = 1e-3, term = 6e6;
    for (int k = 0; k < 6; k++) {
        wt_rubber r = simple(&tau, &term, correlations[k / 2]);
        double s = steps[k % 2], sum = r.law.wlf.c2 + s, shift[N], mean = 0, variance = 0;
        double by_c1 = -s / sum * r.c1_error, by_c2 = r.law.wlf.c1 * s / (sum * sum) * r.c2_error;
        double expected = sqrt(by_c1 * by_c1 + by_c2 * by_c2 + 2 * r.c_correlation * by_c1 * by_c2);
        for (size_t i = 0; i < N; i++) {
            wt_material *m = NULL;
            assert_int_equal(wt_rubber_material(&r, REFERENCE + s, 3, i, &m, NULL, NULL), WT_OK);
            shift[i] = log10(1e7 / m->frequency_max);
            mean += shift[i] / N;
            wt_material_free(m);
        }
        for (size_t i = 0; i < N; i++)
            variance += (shift[i] - mean) * (shift[i] - mean) / (N - 1);
        assert_near(sqrt(variance), expected, 0.12);
        assert_near_abs(mean, -r.law.wlf.c1 * s / sum, 4 * expected / sqrt(N));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_shift_factors),
        cmocka_unit_test(test_law),
        cmocka_unit_test(test_master_curve),
        cmocka_unit_test(test_prony),
        cmocka_unit_test(test_relations),
        cmocka_unit_test(test_relaxation_spectrum),
        cmocka_unit_test(test_draws),
        cmocka_unit_test(test_rubber),
        cmocka_unit_test(test_at),
        cmocka_unit_test(test_shift_error),
    };
    return cmocka_run_group_tests_name("DMA of known truth", tests, make, clean);
}
