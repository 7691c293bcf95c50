/* Dwells: a power law by a hereditary integral in time steps, files by an independent writer,
 * excluded dwells.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "all_formats.h"
#include "table_cells.h"

#include "dma_data.h"
#include "indentation/numerics/relaxation.h"
#include "weartrack/indentation.h"
#include "writers/jpk_writer.h"

#include <math.h>
#include <string.h>
#include <unistd.h>

enum { STEPS = 20000 };

/* E(t) as a power law of time, or with relaxation times a decade apart. */
static bool lines;
static double relaxed(double exponent, double t)
{
    double sum = 1;
    for (int i = -4; i <= 2 && lines; i++)
        sum += 0.4 * pow(10, -0.1 * (i + 4)) * exp(-t / pow(10, i));
    return lines ? sum : pow(t, -exponent);
}

/* Force after a depth that rose over `load` so that the elastic force is time^power: the sum over
 * all steps of the loading. */
static double summed(double exponent, double power, double load, double t)
{
    double sum = 0;
    for (int i = 0; i < STEPS; i++) {
        const double a = load * i / STEPS, b = load * (i + 1) / STEPS;
        sum += (pow(b / load, power) - pow(a / load, power)) * relaxed(exponent, t - 0.5 * (a + b));
    }
    return sum;
}

/* An unusable dwell has a message and no moduli. */
static void test_unusable_dwells(void **state)
{
    (void)state;
    enum { FEW = 64 };
    double time[FEW], position[FEW], flat[FEW];
    wt_contact_table *contact = NULL;
    const wt_tip tip = {.shape = WT_TIP_PARABOLOID, .radius = 5e-6};
    wt_dwell dwell;
    for (int i = 0; i < FEW; i++) {
        time[i] = i;
        position[i] = 1e-8 * (i < FEW / 2 ? i : FEW / 2) - 5e-8;
        flat[i] = 0;
    }
    wt_dwell_history h = {.time = time,
                          .position = position,
                          .force = flat,
                          .n_approach = FEW / 2,
                          .n_dwell = FEW / 2,
                          .spring_constant = 1,
                          .poisson_ratio = 0.5,
                          .modulus = 1e6};
    assert_int_equal(wt_contact_table_new(&tip, 1e-11, 1e-4, &contact, NULL), WT_OK);
    assert_int_equal(wt_dwell_fit(contact, &h, &dwell, NULL), WT_OK);
    assert_string_equal(dwell.reason, "too little baseline for its noise");
    h.contact_point = 1;
    assert_int_equal(wt_dwell_fit(contact, &h, &dwell, NULL), WT_OK);
    assert_string_equal(dwell.reason, "not in contact");
    h.modulus = (double)NAN;
    assert_int_equal(wt_dwell_fit(contact, &h, &dwell, NULL), WT_OK);
    assert_string_equal(dwell.reason, "no contact point from the approach");
    h.modulus = 1;
    time[3] = time[2];
    assert_int_equal(wt_dwell_fit(contact, &h, &dwell, NULL), WT_OK);
    assert_string_equal(dwell.reason, "times that do not rise");
    time[3] = (double)NAN;
    assert_int_equal(wt_dwell_fit(contact, &h, &dwell, NULL), WT_OK);
    assert_string_equal(dwell.reason, "samples without a number");
    assert_false(dwell.found);
    h.n_approach = 0;
    assert_int_equal(wt_dwell_fit(contact, &h, &dwell, NULL), WT_E_ARG);
    wt_contact_table_free(contact);
}

/* ---- files ----------------------------------------------------------------------------------- */

enum { N = 600, CURVES = 6, FREE = 300 };
static const double radius = 5e-6, depth = 400e-9, load_time = 0.2, hold = 4, exponent = 0.12,
                    modulus = 1e6, lever = 5000;
static double height[CURVES][2][N], force[CURVES][2][N], stiffness[CURVES];

static double force_at(double t)
{
    const double g = 4.0 / 3 * sqrt(radius) * pow(depth, 1.5) / 0.75;
    if (t <= 0)
        return 0;
    if (t >= load_time)
        return modulus * g * summed(exponent, 1.5, load_time, t);
    return modulus * g * pow(t / load_time, 1.5) * summed(exponent, 1.5, t, t * (1 + 1e-9));
}

static void write_map(const char *path, uint64_t *seed)
{
    static jpk_writer_segment segments[CURVES][2];
    static jpk_writer_curve curves[CURVES];
    static double known[2][N];
    jpk_writer_file file = jpk_writer_defaults();
    const double step = load_time / (N - FREE);
    for (size_t k = 0; k < N; k++) {
        known[0][k] = force_at(step * ((double)k + 1 - FREE));
        known[1][k] = force_at(load_time + step + hold * (double)k / N);
    }
    for (size_t i = 0; i < CURVES; i++) {
        const double own = stiffness[i] = exp(0.05 * dma_normal(seed));
        for (size_t k = 0; k < N; k++) {
            const double at = depth * ((double)k + 1 - FREE) / (N - FREE);
            for (int s = 0; s < 2; s++)
                force[i][s][k] = own * known[s][k] + 0.002 * known[0][N - 1] * dma_normal(seed);
            height[i][0][k] = 6e-6 - at - own * known[0][k] / lever;
            height[i][1][k] = 6e-6 - depth - own * known[0][N - 1] / lever;
        }
        segments[i][0] =
            (jpk_writer_segment){"extend", N, step * N, height[i][0], force[i][0], NULL};
        segments[i][1] = (jpk_writer_segment){"pause", N, hold, height[i][1], force[i][1], NULL};
        curves[i] = (jpk_writer_curve){i, 0, 0, 2, segments[i]};
    }
    file.path = path;
    file.map = true;
    file.n_curves = CURVES;
    file.curves = curves;
    file.spring_constant = lever;
    file.sensitivity = 50e-9;
    assert_int_equal(jpk_write(&file), 0);
}

static wt_status make(const char *path, wt_tip tip, wt_dwell_tables *tables, wt_error *err)
{
    const char *const paths[] = {path};
    const wt_file_set set = {.patterns = paths, .n_patterns = 1, .read = wt_read_defaults()};
    wt_indent_job job = wt_indent_job_defaults();
    wt_job work = wt_job_defaults();
    work.formats = formats;
    job.sets = &set;
    job.n_sets = 1;
    job.tip = tip;
    return wt_dwell_compute(&job, &work, tables, err);
}

static const char *words(const wt_table *t, size_t row, const char *column)
{
    return wt_table_text(t, row, (size_t)wt_table_find(t, column));
}

/* Each dwell: its times, and force and indentation at its limits. */
static void check_dwells(const wt_table *t, const char *path)
{
    const double step = load_time / (N - FREE), end = load_time + step + hold * (N - 1) / N;
    for (size_t i = 0; i < CURVES; i++) {
        assert_non_null(strstr(words(t, i, "file"), path));
        assert_string_equal(words(t, i, "note"), "");
        assert_near(number_cell(t, i, "curve"), (double)i, 0);
        assert_near(number_cell(t, i, "segment"), 1, 0);
        assert_near(number_cell(t, i, "load_time"), load_time, 0.02);
        assert_near(number_cell(t, i, "duration"), hold, 0.02);
        assert_near(number_cell(t, i, "force_start"), stiffness[i] * force_at(load_time + step),
                    0.03);
        assert_near(number_cell(t, i, "force_end"), stiffness[i] * force_at(end), 0.03);
        assert_near(number_cell(t, i, "indentation_start"), depth, 0.02);
        assert_near(number_cell(t, i, "indentation_end"), depth, 0.02);
        assert_near_abs(number_cell(t, i, "misfit"), 1, 0.5);
        assert_true(number_cell(t, i, "misfit_p") > 1e-3 && number_cell(t, i, "misfit_p") < 1);
        assert_true(isnan(number_cell(t, i, "amplitude")));
    }
}

/* The points of each curve as a block, and the result for an elastic rubber. */
static void check_points(const wt_table *t, const char *path)
{
    const double g = 4.0 / 3 * sqrt(radius) / 0.75;
    size_t row = 0;
    for (size_t i = 0; i < CURVES; i++) {
        double before = 0;
        const size_t first = row;
        for (; row < wt_table_n_rows(t) && number_cell(t, row, "curve") == (double)i; row++) {
            const double time = number_cell(t, row, "time"), f = number_cell(t, row, "force"),
                         z = number_cell(t, row, "indentation");
            assert_true(time > before && time < 1.02 * (load_time + hold));
            assert_int_equal(wt_table_block(t, row), i);
            assert_non_null(strstr(words(t, row, "file"), path));
            if (row % 5 == 0)
                assert_near(f, stiffness[i] * force_at(time), 0.03);
            assert_near(z, depth, 0.02);
            assert_near(number_cell(t, row, "modulus"), f / (g * pow(z, 1.5)), 1e-3);
            assert_near(number_cell(t, row, "fitted_modulus"), number_cell(t, row, "modulus"),
                        0.02);
            before = time;
        }
        assert_true(row - first > 8);
    }
    assert_int_equal(row, wt_table_n_rows(t));
}

/* Each frequency of each dwell by the law: E1 Gamma(1 - n) (i omega)^n. */
static void check_moduli(const wt_table *t, const wt_table *dwells, const char *path)
{
    double pulls = 0;
    size_t n = wt_table_n_rows(t), held = 0, first = 0;
    for (size_t row = 0; row < n; row++) {
        const size_t i = (size_t)number_cell(t, row, "curve");
        const double omega = number_cell(t, row, "angular_frequency"),
                     size = stiffness[i] * modulus * tgamma(1 - exponent) * pow(omega, exponent),
                     storage = size * cos(M_PI_2 * exponent), loss = size * sin(M_PI_2 * exponent);
        assert_true(i < CURVES && omega > 0.2 / hold && omega < 10 / load_time);
        assert_non_null(strstr(words(t, row, "file"), path));
        assert_string_equal(words(t, row, "kind"), "relaxation");
        assert_near(number_cell(t, row, "segment"), 1, 0);
        assert_int_equal(wt_table_block(t, row), i);
        const char *const columns[] = {"storage_modulus", "loss_modulus"};
        const double truth[] = {storage, loss};
        for (size_t c = 0; c < 2; c++) {
            char error[48], common[48];
            snprintf(error, sizeof error, "%s_standard_error", columns[c]);
            snprintf(common, sizeof common, "%s_common_error", columns[c]);
            const double pull =
                (number_cell(t, row, columns[c]) - truth[c]) / number_cell(t, row, error);
            assert_true(fabs(pull) < 4.5);
            assert_true(number_cell(t, row, error) < 0.25 * truth[c]);
            assert_true(number_cell(t, row, common) > 0 &&
                        number_cell(t, row, common) <= number_cell(t, row, error));
            pulls += pull * pull;
        }
        /* the middle one is that of the dwell */
        const bool last = row + 1 == n || number_cell(t, row + 1, "curve") != (double)i;
        held++;
        if (!last)
            continue;
        const size_t middle = first + held / 2;
        const char *const same[] = {"angular_frequency", "storage_modulus",
                                    "storage_modulus_standard_error", "loss_modulus",
                                    "loss_modulus_standard_error"};
        for (size_t c = 0; c < 5; c++)
            assert_near(number_cell(dwells, i, same[c]), number_cell(t, middle, same[c]), 1e-12);
        first = row + 1;
        held = 0;
    }
    assert_true(pulls > 0.1 * 2 * (double)n && pulls < 3 * 2 * (double)n);
}

static void test_relaxation(void **state)
{
    (void)state;
    static const char path[] = "test_dwell.jpk-force-map";
    const wt_tip tip = {.shape = WT_TIP_PARABOLOID, .radius = radius};
    wt_dwell_tables t = {0};
    wt_error err = WT_ERROR_INIT;
    wt_estimate at = {0}, storage = {0}, loss = {0};
    uint64_t seed = 8;
    write_map(path, &seed);
    if (make(path, tip, &t, &err) != WT_OK)
        fail_msg("%s; %s", err.message, err.found);
    assert_int_equal(wt_table_n_rows(t.dwell), CURVES);
    for (size_t i = 0; i < CURVES; i++)
        assert_string_equal(wt_table_text(t.dwell, i, (size_t)wt_table_find(t.dwell, "kind")),
                            "relaxation");
    check_dwells(t.dwell, path);
    check_points(t.dwell_points, path);
    check_moduli(t.dwell_moduli, t.dwell, path);
    assert_string_equal(wt_table_key(t.dwell, "n_units"), "6");
    assert_true(wt_table_estimate(t.dwell, "angular_frequency", &at));
    assert_true(wt_table_estimate(t.dwell, "storage_modulus", &storage));
    assert_true(wt_table_estimate(t.dwell, "loss_modulus", &loss));
    /* E1 (t/1s)^-n is E1 Gamma(1 - n) (i omega)^n. */
    const double true_size = modulus * tgamma(1 - exponent) * pow(at.value, exponent);
    print_message("%g %g +- %g, %g +- %g\n", at.value, storage.value, storage.standard_error,
                  loss.value, loss.standard_error);
    assert_near_abs(loss.value, true_size * sin(M_PI_2 * exponent), 3 * loss.standard_error);
    assert_true(loss.standard_error < 0.05 * loss.value);
    assert_near_abs(storage.value, true_size * cos(M_PI_2 * exponent), 3 * storage.standard_error);
    assert_true(storage.standard_error < 0.05 * storage.value);
    wt_tables_clear(&t, sizeof t);
    (void)remove(path);
    assert_int_equal(make(WT_SOURCE_DIR "/fixtures/case/bulk-1.jpk-force-map", tip, &t, &err),
                     WT_E_EMPTY);
    assert_string_equal(err.message, "no curve dwells behind its approach");
}

/* Single relaxation times are not a broad spectrum: each dwell states it. Neither a dwell nor the
 * mean has an error, because the scatter does not show a shared error. */
static void test_single_relaxation_times(void **state)
{
    (void)state;
    static const char path[] = "test_dwell_lines.jpk-force-map";
    const wt_tip tip = {.shape = WT_TIP_PARABOLOID, .radius = radius};
    wt_dwell_tables t = {0};
    wt_estimate loss = {0};
    uint64_t seed = 3;
    lines = true;
    write_map(path, &seed);
    lines = false;
    assert_int_equal(make(path, tip, &t, NULL), WT_OK);
    const size_t note = (size_t)wt_table_find(t.dwell, "note"),
                 error = (size_t)wt_table_find(t.dwell, "loss_modulus_standard_error");
    size_t seen = 0;
    for (size_t i = 0; i < CURVES; i++) {
        const bool said = strstr(wt_table_text(t.dwell, i, note), "no errors are reported") != NULL;
        assert_int_equal(said, isnan(wt_table_number(t.dwell, i, error)));
        seen += said;
    }
    print_message("%zu of %d\n", seen, CURVES);
    assert_true(seen >= CURVES - 1);
    assert_true(wt_table_estimate(t.dwell, "loss_modulus", &loss));
    assert_true(loss.value > 0 && isnan(loss.standard_error));
    wt_tables_clear(&t, sizeof t);
    (void)remove(path);
}

/* A held segment with a sine, and the same drive without contact, whose drag is to be
 * subtracted. */
static void test_modulation(void **state)
{
    (void)state;
    enum { SINE = 4000, PARTS = 4 };
    static const char path[] = "test_dwell_sine.jpk-force";
    static double h[PARTS][SINE], f[PARTS][SINE];
    static const double drive = 12, amplitude = 4e-9, last = 4;
    const double omega = 2 * M_PI * drive, step = load_time / (N - FREE);
    const double slope = 2 * sqrt(radius * depth) / 0.75,
                 size = modulus * tgamma(1 - exponent) * pow(omega, exponent),
                 storage = size * cos(M_PI_2 * exponent), loss = size * sin(M_PI_2 * exponent),
                 drag = 0.5 * loss * slope, noise = 0.002 * force_at(load_time);
    uint64_t seed = 5;
    for (size_t i = 0; i < N; i++) {
        f[0][i] = force_at(step * ((double)i + 1 - FREE)) + noise * dma_normal(&seed);
        h[0][i] = 6e-6 - depth * ((double)i + 1 - FREE) / (N - FREE) - f[0][i] / lever;
    }
    for (size_t i = 0; i < SINE; i++) {
        const double t = last * (double)i / SINE, sine = amplitude * sin(omega * t),
                     cosine = amplitude * cos(omega * t);
        f[1][i] = i % 20 == 0 || i < 20 ? force_at(load_time + step + t) : 0;
        f[3][i] = drag * cosine + 0.1 * noise * dma_normal(&seed);
        h[3][i] = 8e-6 - sine;
        h[1][i] = 6e-6 - depth - sine;
        f[2][i] = 0;
        h[2][i] = 6e-6 + 4e-9 * (double)i;
    }
    for (size_t i = 20; i < SINE; i++) /* between those that were summed */
        if (i % 20 != 0) {
            const size_t from = i / 20 * 20, to = from + 20 < SINE ? from + 20 : from;
            const double end = to > from ? force_at(load_time + step + last * (double)to / SINE)
                                         : force_at(load_time + step + last);
            f[1][i] += f[1][from] + (end - f[1][from]) * (double)(i - from) / 20;
        }
    for (size_t i = 0; i < SINE; i++) {
        const double t = last * (double)i / SINE;
        f[1][i] += amplitude * ((storage * slope) * sin(omega * t) +
                                (loss * slope + drag) * cos(omega * t)) +
                   noise * dma_normal(&seed);
        h[1][i] -= f[1][i] / lever;
        h[3][i] -= f[3][i] / lever;
    }
    const jpk_writer_segment segments[PARTS] = {{"extend", N, step * N, h[0], f[0], NULL},
                                                {"modulation", SINE, last, h[1], f[1], NULL},
                                                {"retract", SINE, 1, h[2], f[2], NULL},
                                                {"modulation", SINE, last, h[3], f[3], NULL}};
    const jpk_writer_curve curve = {0, 0, 0, PARTS, segments};
    jpk_writer_file file = jpk_writer_defaults();
    file.path = path;
    file.n_curves = 1;
    file.curves = &curve;
    file.spring_constant = lever;
    file.sensitivity = 50e-9;
    assert_int_equal(jpk_write(&file), 0);
    const wt_tip tip = {.shape = WT_TIP_PARABOLOID, .radius = radius};
    wt_dwell_tables t = {0};
    wt_error err = WT_ERROR_INIT;
    if (make(path, tip, &t, &err) != WT_OK)
        fail_msg("%s; %s", err.message, err.found);
    assert_int_equal(wt_table_n_rows(t.dwell), 2);
#define CELL(name) wt_table_number(t.dwell, 1, (size_t)wt_table_find(t.dwell, name))
    assert_string_equal(wt_table_text(t.dwell, 1, (size_t)wt_table_find(t.dwell, "kind")),
                        "modulation");
    print_message("%g %g (%g) %g (%g) %s\n", CELL("angular_frequency"), CELL("storage_modulus"),
                  storage, CELL("loss_modulus"), loss,
                  wt_table_text(t.dwell, 1, (size_t)wt_table_find(t.dwell, "note")));
    assert_near(CELL("angular_frequency"), omega, 1e-4);
    assert_near(CELL("amplitude"), amplitude, 0.01);
    /* Noise leaves 1.5 % of the loss; without weights the relaxation removes 7 % of it. */
    assert_near(CELL("storage_modulus"), storage, 0.01);
    assert_near(CELL("loss_modulus"), loss, 0.02);
    assert_true(isnan(CELL("storage_modulus_standard_error"))); /* a sine states none */
    assert_true(isnan(CELL("loss_modulus_standard_error")));
    assert_near(CELL("indentation_start"), depth, 0.01);
    /* mean of the relaxing force, with a weight that falls to zero at both ends */
    double mean = 0;
    for (int i = 0; i < 50; i++)
        mean += (1 - cos(2 * M_PI * (i + 0.5) / 50)) *
                force_at(load_time + step + last * (i + 0.5) / 50) / 50;
    assert_near(CELL("force_start"), mean, 0.01);
    assert_near(CELL("curve"), 0, 0);
    assert_near(CELL("segment"), 1, 0);
    const size_t n_moduli = wt_table_n_rows(t.dwell_moduli) - 1;
    assert_string_equal(words(t.dwell_moduli, n_moduli, "kind"), "modulation");
    assert_near(number_cell(t.dwell_moduli, n_moduli, "storage_modulus"), CELL("storage_modulus"),
                0);
    assert_near(number_cell(t.dwell_moduli, n_moduli, "loss_modulus"), CELL("loss_modulus"), 0);
    /* error of the depth by the contact point, through the slope of the sphere's contact */
    const double of_storage = number_cell(t.dwell_moduli, n_moduli, "storage_modulus_common_error"),
                 of_loss = number_cell(t.dwell_moduli, n_moduli, "loss_modulus_common_error");
    assert_true(of_storage > 0 && of_storage < 0.02 * storage);
    assert_near(of_loss / CELL("loss_modulus"), of_storage / CELL("storage_modulus"), 1e-9);
#undef CELL
    wt_tables_clear(&t, sizeof t);
    (void)remove(path);
}

/* A pause of 3 s on a gel. */
static void test_measured_dwell(void **state)
{
    (void)state;
    static const char path[] =
        WT_SHARED_DIR "/data/afm/jpk/fmt-jpk-cc_pr14-polymergel-2021.06.30.jpk-force";
    const wt_tip tip = {.shape = WT_TIP_PARABOLOID, .radius = 5e-6};
    wt_dwell_tables t = {0};
    if (access(path, R_OK) != 0)
        skip();
    assert_int_equal(make(path, tip, &t, NULL), WT_OK);
    assert_int_equal(wt_table_n_rows(t.dwell), 1);
    wt_tables_clear(&t, sizeof t);
}

/* An adhesive retraction: the neck lasts until 4 um above the contact point, four times the depth,
 * and the force after it is that of the baseline. The free part begins after the neck. */
static void test_adhesive_neck(void **state)
{
    (void)state;
    enum { IN = 600, HELD = 600, OUT = 700 };
    static double time[IN + HELD + OUT], position[IN + HELD + OUT], forces[IN + HELD + OUT];
    uint64_t seed = 1;
    for (int i = 0; i < IN + HELD + OUT; i++) {
        const double in = i < IN          ? (double)(2 * i - IN) / IN
                          : i < IN + HELD ? 1
                                          : 1 - 7.0 * (i - IN - HELD + 1) / OUT; /* [um] */
        const bool neck = i >= IN + HELD && in < 0 && in > -4;
        time[i] = 1e-3 * i;
        position[i] = 1e-6 * in;
        forces[i] = 1e-9 * (in > 0 ? in : neck ? in : 0) + 1e-13 * dma_normal(&seed);
    }
    const wt_dwell_history h = {.time = time,
                                .position = position,
                                .force = forces,
                                .n_approach = IN,
                                .n_dwell = HELD,
                                .n_retract = OUT,
                                .spring_constant = 1,
                                .poisson_ratio = 0.5,
                                .modulus = 1e6};
    arena memory = {0};
    dwell_nodes nodes;
    assert_string_equal(dwell_nodes_create(&h, 1e-3, &memory, &nodes), "");
    assert_true(nodes.n > nodes.first_free);
    for (size_t i = nodes.first_free; i < nodes.n; i++) {
        assert_true(nodes.position[i] < -4e-6);
        assert_near_abs(nodes.force[i], 0, 1e-12);
    }
    arena_free(&memory);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_unusable_dwells),         cmocka_unit_test(test_relaxation),
        cmocka_unit_test(test_single_relaxation_times), cmocka_unit_test(test_modulation),
        cmocka_unit_test(test_measured_dwell),          cmocka_unit_test(test_adhesive_neck)};
    return cmocka_run_group_tests(tests, open_formats, free_formats);
}
