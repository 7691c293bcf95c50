/* The jobs one by one: many curves, positions, groups, the rubber at a temperature, surfaces, the
 * layer.
 * SPDX-License-Identifier: GPL-3.0-or-later */

#include "all_formats.h"
#include "table_cells.h"

#include "core/base/array.h"
#include "job/random_draws.h"
#include "weartrack/study.h"
#include "writers/jpk_writer.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define CASE WT_SOURCE_DIR "/fixtures/case"

static wt_job common_job(void)
{
    wt_job job = wt_job_defaults();
    job.formats = formats;
    job.threads = 1;
    job.replicates = 8;
    return job;
}

static wt_indent_job bulk_job(const wt_file_set *sets, size_t n)
{
    wt_indent_job job = wt_indent_job_defaults();
    assert_int_equal(wt_tip_parse("pyramid:half-angle=20deg,radius=20nm", &job.tip, NULL), WT_OK);
    job.sets = sets;
    job.n_sets = n;
    return job;
}

static wt_file_set files(const char *const *patterns, size_t n, const char *spot)
{
    return (wt_file_set){.patterns = patterns,
                         .n_patterns = n,
                         .folder = CASE,
                         .read = wt_read_defaults(),
                         .spot = spot};
}

/* ---- indentation ----------------------------------------------------------------------------- */

/* A law without a series has no spectrum: the curves are fitted as without a material. */
static void test_material_without_a_spectrum(void **state)
{
    (void)state;
    const char *const names[] = {"bulk-1.jpk-force-map"};
    const wt_file_set set = files(names, 1, NULL);
    const wt_rubber zener = {.kind = WT_RUBBER_ZENER,
                             .zener = {.e0 = 5e6, .eg = 2e9, .tau = 1e-6, .alpha = 0.4},
                             .poisson_ratio = 0.5,
                             .prony = {.reference_temperature = 293.15}};
    wt_indent_job job = bulk_job(&set, 1);
    wt_job work = common_job();
    wt_indent_tables plain = {0}, given = {0};
    wt_error err = WT_ERROR_INIT;
    work.log = wt_log_new();
    assert_int_equal(wt_indent_group(&job, &work, &plain, NULL), WT_OK);
    const size_t notes = wt_log_count(work.log);
    job.rubber = &zener;
    if (wt_indent_group(&job, &work, &given, &err) != WT_OK)
        fail_msg("%s", err.message);
    assert_true(wt_log_count(work.log) > notes);
    assert_int_equal(wt_table_n_rows(given.indentation), wt_table_n_rows(plain.indentation));
    for (size_t i = 0; i < wt_table_n_rows(plain.indentation); i++)
        assert_near(number_cell(given.indentation, i, "modulus"),
                    number_cell(plain.indentation, i, "modulus"), 0);
    assert_null(wt_table_key(given.indentation, "spectrum_temperature"));
    wt_log_free(work.log);
    wt_indent_tables_clear(&plain);
    wt_indent_tables_clear(&given);
}

/* An invalid file is recorded and the others are fitted; a file named twice counts once. */
static void test_bad_files(void **state)
{
    (void)state;
    static const char *const patterns[] = {"bulk-1.jpk-force-map", "dma.txt", "no-such-*",
                                           "bulk-[12].jpk-force-map"};
    const wt_file_set set = files(patterns, 4, NULL);
    const wt_indent_job job = bulk_job(&set, 1);
    wt_job common = common_job();
    wt_indent_tables tables = {0};
    wt_error err = WT_ERROR_INIT;

    /* without a list of failures the first failure ends the job and names the file */
    wt_status status = wt_indent_group(&job, &common, &tables, &err);
    assert_int_equal(status, WT_E_NOT_FOUND);
    assert_null(tables.indentation);
    assert_string_equal(wt_path_base(err.file), "no-such-*");
    const wt_file_set sweep = files(&patterns[1], 1, NULL);
    const wt_indent_job other = bulk_job(&sweep, 1);
    assert_int_not_equal(wt_indent_group(&other, &common, &tables, &err), WT_OK);
    assert_string_equal(wt_path_base(err.file), "dma.txt");
    err = (wt_error)WT_ERROR_INIT;

    common.failures = wt_failures_new();
    common.log = wt_log_new();
    common.provenance = wt_provenance_new();
    assert_int_equal(wt_indent_group(&job, &common, &tables, &err), WT_OK);
    assert_int_equal(wt_table_n_rows(common.failures), 2);
    assert_string_equal(wt_table_text(common.failures, 0, 0), "no-such-*");
    assert_string_equal(wt_table_text(common.failures, 1, 0), "dma.txt");
    assert_int_equal(wt_table_n_rows(tables.indentation), 24);
    assert_int_equal(tables.n_accepted, 24);
    /* one file was read and failed, the other one does not exist */
    assert_int_equal(tables.n_failed, 1);
    static const char *const said[] = {"taken once", "24 of 24 accepted curves lose work"};
    assert_int_equal(wt_log_count(common.log), 2);
    for (size_t i = 0; i < 2; i++)
        assert_non_null(strstr(wt_log_get(common.log, i).text, said[i]));
    assert_int_equal(wt_provenance_n_inputs(common.provenance), 2);
    assert_string_equal(wt_provenance_get_input(common.provenance, 1)->path,
                        "bulk-2.jpk-force-map");
    for (size_t i = 0; i < 24; i++) {
        assert_string_equal(text_cell(tables.indentation, i, "file"),
                            i < 12 ? "bulk-1.jpk-force-map" : "bulk-2.jpk-force-map");
        assert_near(number_cell(tables.indentation, i, "curve"), (double)(i % 12), 0);
    }
    wt_provenance_free(common.provenance);
    wt_log_free(common.log);
    wt_table_free(common.failures);
    wt_indent_tables_clear(&tables);
}

static wt_table *fit(const wt_file_set *sets, size_t n, unsigned threads, bool rates)
{
    wt_indent_job job = bulk_job(sets, n);
    wt_job common = common_job();
    wt_indent_tables tables = {0};
    wt_error err = WT_ERROR_INIT;
    common.threads = threads;
    job.rates = rates;
    job.median_curve = true;
    if (wt_indent_group(&job, &common, &tables, &err) != WT_OK)
        fail_msg("%s: %s", err.file, err.message);
    wt_table *table = tables.indentation;
    tables.indentation = NULL;
    assert_true(wt_table_n_rows(tables.force_displacement) == 520);
    assert_true(wt_table_n_rows(tables.force_indentation) > 100);
    wt_indent_tables_clear(&tables);
    return table;
}

static void test_threads_and_rates(void **state)
{
    (void)state;
    static const char *const patterns[] = {"bulk-*"};
    const wt_file_set set = files(patterns, 1, NULL);
    wt_table *one = fit(&set, 1, 1, true), *three = fit(&set, 1, 3, true);
    wt_table *without = fit(&set, 1, 2, false);
    for (size_t c = 0; c < wt_table_n_columns(one); c++)
        if (wt_table_column_kind(one, c) == WT_COLUMN_NUMBER)
            assert_memory_equal(wt_table_numbers(one, c), wt_table_numbers(three, c),
                                wt_table_n_rows(one) * sizeof(double));
    for (size_t i = 0; i < wt_table_n_rows(one); i++) {
        assert_true(number_cell(one, i, "equivalent_frequency") > 0);
        assert_near(number_cell(without, i, "modulus"), number_cell(one, i, "modulus"), 0);
        assert_near(number_cell(without, i, "piezo_rate"), (double)NAN, 0);
        assert_near(number_cell(without, i, "load_time"), (double)NAN, 0);
    }
    wt_table_free(one);
    wt_table_free(three);
    wt_table_free(without);
}

/* More curves than the job holds at once, each stiffer than the previous one. Every curve has its
 * row in file order, for any number of threads. */
static void test_many_curves(void **state)
{
    (void)state;
    enum { CURVES = 530, N = 120 };
    static double height[N], force[CURVES][N];
    static jpk_writer_segment segments[CURVES];
    static jpk_writer_curve curves[CURVES];
    const char *const path = "many.jpk-force-map";
    const wt_file_set set = {.patterns = &path, .n_patterns = 1, .read = wt_read_defaults()};
    const wt_indent_job job = bulk_job(&set, 1);
    jpk_writer_file file = jpk_writer_defaults();
    for (size_t i = 0; i < N; i++)
        height[i] = -1e-9 * (double)i;
    for (size_t c = 0; c < CURVES; c++) {
        for (size_t i = 0; i < N; i++) {
            double g, slope;
            wt_contact_function(&job.tip, 1e-9 * ((double)i - 80.3), &g, &slope);
            force[c][i] = 1e6 * (1.0 + 0.01 * (double)c) * g + 1e-13 * (double)(i % 2);
        }
        segments[c] = (jpk_writer_segment){
            .style = "extend", .n = N, .duration = 0.1, .height = height, .force = force[c]};
        curves[c] = (jpk_writer_curve){.index = c, .n_segments = 1, .segments = &segments[c]};
    }
    file.path = path;
    file.map = true;
    file.curves = curves;
    file.n_curves = CURVES;
    file.spring_constant = 1e3;
    file.sensitivity = 50e-9;
    assert_int_equal(jpk_write(&file), 0);
    for (unsigned threads = 1; threads <= 3; threads += 2) {
        wt_job common = common_job();
        wt_indent_tables tables = {0};
        wt_error err = WT_ERROR_INIT;
        common.threads = threads;
        if (wt_indent_group(&job, &common, &tables, &err) != WT_OK)
            fail_msg("%s: %s", err.file, err.message);
        assert_int_equal(wt_table_n_rows(tables.indentation), CURVES);
        for (size_t i = 0; i < CURVES; i++) {
            assert_near(number_cell(tables.indentation, i, "curve"), (double)i, 0);
            assert_near(number_cell(tables.indentation, i, "max_force"), force[i][N - 1], 0.02);
        }
        wt_indent_tables_clear(&tables);
    }
    assert_int_equal(unlink(path), 0);
}

static void check_spots(const wt_file_set *sets, size_t n, const char *key, size_t expected)
{
    wt_table *table = fit(sets, n, 1, false), *groups = NULL;
    const wt_table *const listed[] = {table};
    assert_int_equal(strncmp(wt_table_key(table, "spots"), key, strlen(key)), 0);
    assert_int_equal(wt_modulus_groups_table(listed, 1, &groups, NULL), WT_OK);
    assert_near(number_cell(groups, 0, "n_spots"), (double)expected, 0);
    assert_string_equal(text_cell(groups, 0, "group"), "bulk");
    wt_table_free(groups);
    wt_table_free(table);
}

static void test_spots(void **state)
{
    (void)state;
    static const char *const one[] = {"bulk-1.jpk-force-map"}, *const three[] = {"bulk-[123]*"};
    const wt_file_set named[] = {files(one, 1, "a"), files(three, 1, "b")};
    const wt_file_set mixed[] = {files(one, 1, "a"), files(three, 1, NULL)};
    check_spots(&mixed[1], 1, "file", 3);
    check_spots(named, 2, "named", 2);
    check_spots(mixed, 2, "mixed", 3);
    wt_group_data none = {0};
    assert_int_equal(wt_group_from_table(NULL, false, &none, NULL), WT_E_ARG);
    const wt_file_set single = files(one, 1, NULL);
    check_spots(&single, 1, "file", 1); /* a map is one position, unless its points are to count */
    wt_table *map = fit(&single, 1, 1, false);
    wt_group_data places = {0};
    assert_int_equal(wt_group_from_table(map, true, &places, NULL), WT_OK);
    assert_true(places.group.n > 1);
    for (size_t i = 0; i < places.group.n; i++)
        assert_int_equal(places.spot[i], (long)i);
    wt_group_data_clear(&places);
    wt_table_free(map);
}

/* ---- comparison ------------------------------------------------------------------------------ */

static void test_one_spot(void **state)
{
    (void)state;
    static const char *const bulk[] = {"bulk-1.jpk-force-map"}, *const track[] = {"track-1*",
                                                                                  "track-2*"};
    const wt_file_set b = files(bulk, 1, "b"), t = files(track, 2, NULL);
    wt_table *x = fit(&b, 1, 1, true), *y = fit(&t, 1, 1, true);
    wt_compare_job job = wt_compare_job_defaults();
    job.bulk = x;
    job.track = y;
    wt_job common = common_job();
    wt_compare_tables tables = {0};
    assert_int_equal(wt_compare_groups(&job, &common, &tables, NULL), WT_OK);
    const char *differs = wt_table_key(tables.comparison, "differs");
    assert_non_null(strstr(differs, "inconclusive: the bulk was measured on one spot"));
    assert_non_null(strstr(wt_table_key(tables.comparison, "settled_by"), "spots in each group"));
    assert_true(number_cell(tables.comparison, 0, "ratio") < 1);
    assert_true(isnan(number_cell(tables.comparison, 0, "ratio_high")));
    /* the place names the groups, not the tables */
    assert_string_equal(text_cell(tables.modulus_groups, 1, "group"), "track");
    assert_int_equal(wt_table_n_rows(tables.modulus_rate), 6);
    assert_null(tables.dma_comparison);
    wt_tables_clear(&tables, sizeof tables);

    /* the tables as read from a stream by another program give the same comparison */
    FILE *file = tmpfile();
    wt_table *again = NULL;
    wt_estimate direct, read_back;
    assert_int_equal(wt_stream_write(file, x, NULL, NULL), WT_OK);
    rewind(file);
    assert_int_equal(wt_stream_read(file, "table", &again, NULL), WT_OK);
    fclose(file);
    assert_int_equal(wt_compare_groups(&job, &common, &tables, NULL), WT_OK);
    assert_true(wt_table_estimate(tables.comparison, "modulus_ratio", &direct));
    const double value = direct.value;
    wt_tables_clear(&tables, sizeof tables);
    job.bulk = again;
    assert_int_equal(wt_compare_groups(&job, &common, &tables, NULL), WT_OK);
    assert_true(wt_table_estimate(tables.comparison, "modulus_ratio", &read_back));
    assert_near(read_back.value, value, 0);
    wt_tables_clear(&tables, sizeof tables);
    wt_table_free(again);

    /* bulk only: groups and rates, no comparison */
    job.bulk = x;
    job.track = NULL;
    assert_int_equal(wt_compare_groups(&job, &common, &tables, NULL), WT_OK);
    assert_null(tables.comparison);
    assert_int_equal(wt_table_n_rows(tables.modulus_groups), 1);
    wt_tables_clear(&tables, sizeof tables);
    wt_table_free(x);
    wt_table_free(y);
}

/* ---- rubber ---------------------------------------------------------------------------------- */

static wt_rubber measured_rubber(wt_master_tables *tables)
{
    static const char *const patterns[] = {"dma.txt"};
    const wt_file_set set = files(patterns, 1, NULL);
    wt_master_job job = wt_master_job_defaults();
    wt_job common = common_job();
    wt_rubber rubber = {0};
    wt_error err = WT_ERROR_INIT;
    job.sets = &set;
    job.n_sets = 1;
    job.fit.reference_temperature = 293.15;
    if (wt_master_compute(&job, &common, tables, &rubber, &err) != WT_OK)
        fail_msg("%s: %s", err.file, err.message);
    return rubber;
}

/* There is no vertical shift at the reference temperature, also if it lies outside the
 * isotherms. */
static void test_rubber_at_reference(void **state)
{
    (void)state;
    double relaxation_time = 1e-3, modulus = 1e6, temperature[2] = {280, 290},
           log_b[2] = {0.05, 0.03}, storage, loss;
    const double omega = 1e-6;
    wt_rubber rubber = {.prony = {.deformation = WT_TENSION,
                                  .reference_temperature = 300,
                                  .equilibrium_modulus = 2e6,
                                  .n = 1,
                                  .relaxation_time = &relaxation_time,
                                  .modulus = &modulus},
                        .poisson_ratio = 0.5,
                        .law = {.kind = WT_LAW_WLF, .wlf = {300, 6, 100}},
                        .n_vertical = 2,
                        .vertical_temperature = temperature,
                        .vertical_log_b = log_b};
    const struct {
        double at, log_b;
    } cases[] = {{300, 0}, {(double)NAN, 0}, {295, 0.015}, {290, 0.03}, {285, 0.04}, {305, 0}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        wt_material *material = NULL;
        assert_int_equal(
            wt_rubber_material(&rubber, cases[i].at, 1, WT_NO_REPLICATE, &material, NULL, NULL),
            WT_OK);
        material->law->modulus(material, &omega, 1, &storage, &loss);
        assert_near(storage, 2e6 / pow(10, cases[i].log_b), 1e-9);
        wt_material_free(material);
    }
}

/* The material at another temperature is the one measured there: the moduli of the 60 degC
 * isotherm, with E = 3 G, although friction does not use that isotherm directly. */
static void test_rubber_at(void **state)
{
    (void)state;
    wt_master_tables tables = {0};
    wt_rubber rubber = measured_rubber(&tables), read_back = {0};
    wt_material *material = NULL, *again = NULL;
    char statement[256] = "", line[512];
    FILE *in = fopen(CASE "/dma.txt", "r");
    size_t n = 0;
    bool here = false;
    assert_non_null(in);
    assert_int_equal(
        wt_rubber_material(&rubber, 333.15, 1, WT_NO_REPLICATE, &material, statement, NULL), WT_OK);
    assert_string_equal(statement, "");
    while (fgets(line, sizeof line, in) != NULL) {
        double t, omega, f, torque, storage, loss, e1, e2;
        if (strncmp(line, "Step name", 9) == 0)
            here = strstr(line, "(60.0") != NULL;
        if (!here || sscanf(line, "Data point %lf %lf %lf %lf %lf %lf", &t, &omega, &f, &torque,
                            &storage, &loss) != 6)
            continue;
        material->law->modulus(material, &omega, 1, &e1, &e2);
        assert_near(e1, 3e6 * storage, 0.03);
        assert_near(e2, 3e6 * loss, 0.12);
        n++;
    }
    fclose(in);
    assert_int_equal(n, 16);

    /* the same from the tables */
    const wt_rubber_tables stored = {.prony = tables.prony, .shift_factors = tables.shift_factors};
    assert_int_equal(wt_rubber_from_tables(&stored, 0.5, &read_back, NULL), WT_OK);
    assert_int_equal(wt_rubber_material(&read_back, 333.15, 1, WT_NO_REPLICATE, &again, NULL, NULL),
                     WT_OK);
    const double omega = 2.385;
    double a[2], b[2];
    material->law->modulus(material, &omega, 1, &a[0], &a[1]);
    again->law->modulus(again, &omega, 1, &b[0], &b[1]);
    assert_near(b[0], a[0], 1e-10);
    assert_near(b[1], a[1], 1e-10);
    assert_near(again->frequency_max, material->frequency_max, 1e-10);
    wt_material_free(again);
    wt_material_free(material);

    /* outside the isotherms there is a warning; below the pole there is no law */
    assert_int_equal(
        wt_rubber_material(&rubber, 383.15, 1, WT_NO_REPLICATE, &material, statement, NULL), WT_OK);
    assert_non_null(strstr(statement, "outside the isotherms"));
    assert_non_null(strstr(statement, "vertical shift held"));
    wt_material_free(material);
    assert_int_equal(wt_rubber_material(&rubber, 170, 1, WT_NO_REPLICATE, &material, NULL, NULL),
                     WT_E_RANGE);

    /* replicates differ, and are reproducible */
    double e[3], loss;
    const size_t index[3] = {0, 1, 0};
    for (int i = 0; i < 3; i++) {
        assert_int_equal(wt_rubber_material(&rubber, 333.15, 1, index[i], &material, NULL, NULL),
                         WT_OK);
        material->law->modulus(material, &omega, 1, &e[i], &loss);
        wt_material_free(material);
    }
    assert_near(e[2], e[0], 0);
    assert_true(fabs(e[1] / e[0] - 1) > 1e-6 && fabs(e[1] / e[0] - 1) < 0.1);

    /* without a law only the reference temperature is possible */
    rubber.law.kind = WT_LAW_NONE;
    assert_int_equal(wt_rubber_material(&rubber, 293.65, 1, WT_NO_REPLICATE, &material, NULL, NULL),
                     WT_OK);
    wt_material_free(material);
    assert_int_equal(wt_rubber_material(&rubber, 298.15, 1, WT_NO_REPLICATE, &material, NULL, NULL),
                     WT_E_MISSING);
    wt_rubber_clear(&read_back);
    wt_rubber_clear(&rubber);
    wt_master_tables_clear(&tables);
}

/* ---- surface --------------------------------------------------------------------------------- */

static void test_surface_text(void **state)
{
    (void)state;
    const wt_job common = common_job();
    wt_surface surface = {0};
    wt_table *table = NULL;
    wt_estimate height;
    assert_int_equal(
        wt_surface_open("self-affine:q0=1e3rad/m,qr=4e3rad/m,q1=1e6rad/m,hurst=0.8,c0=1e-17m^4+-8%",
                        NULL, &common, &surface, NULL),
        WT_OK);
    assert_near(surface.c0.standard_error, 8e-19, 1e-12);
    assert_int_equal(wt_surface_table(&surface, &table, NULL), WT_OK);
    assert_true(wt_table_estimate(table, "rms_height", &height));
    assert_near(height.standard_error, 0.04 * height.value, 1e-12);
    wt_table_free(table);
    wt_surface_clear(&surface);
    static const char *const wrong[] = {
        "self-affine:q0=1e3rad/m,q1=1e6rad/m,hurst=0.8",
        "self-affine:q0=1e3,q1=1e6rad/m,hurst=0.8,c0=1e-17m^4",
        "self-affine:q0=1e7rad/m,q1=1e6rad/m,hurst=0.8,c0=1e-17m^4",
        "self-affine:q0=1e3rad/m,q1=1e6rad/m,hurst=0.8,c0=1e-17m^4,foam=3",
        "self-affine:q0=1e3rad/m+-5%,q1=1e6rad/m,hurst=0.8,c0=1e-17m^4",
        CASE "/no-such-file",
        CASE "/dma.txt",
    };
    for (size_t i = 0; i < COUNT_OF(wrong); i++) {
        wt_error err = WT_ERROR_INIT;
        assert_int_not_equal(wt_surface_open(wrong[i], NULL, &common, &surface, &err), WT_OK);
        assert_true(err.message[0] != '\0');
    }
}

/* A self-affine law that is sampled at a few points and truncated between them equals the truncated
 * law. */
static void test_surface_truncated(void **state)
{
    (void)state;
    double q[8], c[8], slope[2];
    for (int i = 0; i < 8; i++) {
        q[i] = 1e3 * pow(10, 0.5 * i);
        c[i] = 1e-17 * pow(q[i] / 1e3, -3.6);
    }
    wt_surface spectrum = {.q0 = 2.385e3,
                           .q1 = 1.7e6,
                           .c0 = {1, 0, 0, "1"},
                           .spectrum = {.n = 8, .wavenumber = q, .density = c}};
    wt_surface law = {.self_affine = true,
                      .q0 = 2.385e3,
                      .qr = 2.385e3,
                      .q1 = 1.7e6,
                      .hurst = 0.8,
                      .c0 = {1e-17 * pow(2.385, -3.6), 0, 0, "m^4"}};
    const wt_surface *const both[2] = {&spectrum, &law};
    for (int i = 0; i < 2; i++) {
        wt_roughness *roughness = NULL;
        assert_int_equal(wt_surface_roughness(both[i], 4, &roughness, NULL), WT_OK);
        slope[i] = wt_roughness_rms_slope(roughness);
        assert_near(roughness->q1, 1.7e6, 0);
        wt_roughness_free(roughness);
    }
    assert_near(slope[0], slope[1], 1e-9);
    spectrum.q1 = 1e9;
    wt_roughness *roughness = NULL;
    assert_int_equal(wt_surface_roughness(&spectrum, 1, &roughness, NULL), WT_E_RANGE);
}

/* ---- layer ----------------------------------------------------------------------------------- */

/* The critical energy from an observed thickness reproduces that thickness. */
static void test_calibration(void **state)
{
    (void)state;
    const wt_job common = common_job();
    double tau[] = {1e-6, 1e-4}, modulus[] = {300e6, 10e6};
    const double velocity[] = {0.3};
    wt_rubber rubber = {.prony = {.deformation = WT_TENSION,
                                  .reference_temperature = 293.15,
                                  .equilibrium_modulus = 3e6,
                                  .n = 2,
                                  .relaxation_time = tau,
                                  .modulus = modulus,
                                  .frequency_min = (double)NAN,
                                  .frequency_max = (double)NAN},
                        .poisson_ratio = 0.5,
                        .temperature_min = (double)NAN,
                        .temperature_max = (double)NAN};
    wt_surface surface = {.self_affine = true,
                          .q0 = 2e3,
                          .qr = 4e3,
                          .q1 = 1e6,
                          .hurst = 0.8,
                          .c0 = {2e-17, 0, 0, "m^4"}};
    wt_sliding sliding = wt_sliding_defaults();
    sliding.rubber = &rubber;
    sliding.surface = &surface;
    sliding.pressure.value = 0.4e6;
    sliding.velocity = velocity;
    sliding.n_velocity = 1;
    wt_layer_job job = wt_layer_job_defaults();
    job.observed_thickness.value = 2.385e-6;
    job.specific_wear_rate.value = 1e-12;
    wt_layer_tables tables = {0};
    wt_estimate energy;
    assert_int_equal(wt_layer_thickness_compute(&sliding, &job, &common, &tables, NULL), WT_OK);
    assert_near(tables.thickness.value, 2.385e-6, 1e-8);
    assert_true(wt_table_estimate(tables.layer, "critical_energy", &energy));
    assert_string_equal(wt_table_key(tables.layer, "standard_error_includes"),
                        "nothing, for no error was measured or stated");
    assert_near(tables.thickness.standard_error, (double)NAN, 0);
    const double given = energy.value;
    wt_table_free(tables.layer);

    job.critical_energy.value = given;
    job.observed_thickness.value = (double)NAN;
    job.duty = 0.02; /* a duty cycle slows the growth and does not change the steady state */
    assert_int_equal(wt_layer_thickness_compute(&sliding, &job, &common, &tables, NULL), WT_OK);
    assert_near(tables.thickness.value, 2.385e-6, 1e-8);
    wt_table_free(tables.layer);

    job.observed_thickness.value = 1e-6;
    assert_int_equal(wt_layer_thickness_compute(&sliding, &job, &common, &tables, NULL), WT_E_ARG);
    job.critical_energy.value = job.observed_thickness.value = (double)NAN;
    assert_int_equal(wt_layer_thickness_compute(&sliding, &job, &common, &tables, NULL),
                     WT_E_MISSING);
    job.critical_energy.value = given;
    job.specific_wear_rate.value = (double)NAN;
    assert_int_equal(wt_layer_thickness_compute(&sliding, &job, &common, &tables, NULL),
                     WT_E_MISSING);
}

/* ---- draws ----------------------------------------------------------------------------------- */

/* The result states the effect of wear on the thickness and the time of the layer. Both agree with
 * a layer computed again. */
static void test_layer_numbers(void **state)
{
    (void)state;
    double velocity = 0.3;
    wt_master_tables master = {0};
    wt_rubber rubber = measured_rubber(&master);
    wt_surface surface = {.self_affine = true, .q0 = 2e3, .qr = 4e3, .q1 = 2e6, .hurst = 0.8};
    surface.c0 = (wt_estimate){2e-17, 0, 0, "m^4"};
    wt_sliding sliding = wt_sliding_defaults();
    wt_job common = common_job();
    wt_layer_job job = wt_layer_job_defaults();
    wt_layer_tables tables = {0}, other = {0};
    wt_estimate sensitivity, settled, again;
    common.replicates = 0;
    sliding.rubber = &rubber;
    sliding.surface = &surface;
    sliding.pressure.value = 4e5;
    sliding.velocity = &velocity;
    sliding.n_velocity = 1;
    job.critical_energy.value = 2e10;
    job.specific_wear_rate.value = 1e-12;
    assert_int_equal(wt_layer_thickness_compute(&sliding, &job, &common, &tables, NULL), WT_OK);
    assert_true(wt_table_estimate(tables.layer, "wear_sensitivity", &sensitivity));
    assert_true(wt_table_estimate(tables.layer, "time_to_90_percent", &settled));

    job.specific_wear_rate.value *= 1.0001;
    assert_int_equal(wt_layer_thickness_compute(&sliding, &job, &common, &other, NULL), WT_OK);
    assert_near(log(other.thickness.value / tables.thickness.value) / log(1.0001),
                sensitivity.value, 1e-3);
    wt_table_free(other.layer);

    job.specific_wear_rate.value = 1e-12;
    job.time = &settled.value;
    job.n_time = 1;
    assert_int_equal(wt_layer_thickness_compute(&sliding, &job, &common, &other, NULL), WT_OK);
    assert_near(number_cell(other.layer, 0, "thickness"), 0.9 * tables.thickness.value, 1e-9);
    /* the output times have no effect */
    assert_true(wt_table_estimate(other.layer, "time_to_90_percent", &again));
    assert_near(again.value, settled.value, 0);
    assert_true(settled.numerical_error > 0 && settled.numerical_error < 1e-6 * settled.value);
    wt_table_free(other.layer);
    wt_table_free(tables.layer);
    wt_master_tables_clear(&master);
    wt_rubber_clear(&rubber);
}

static void test_draws(void **state)
{
    (void)state;
    enum { N = 20000 };
    double *x = malloc(N * sizeof *x), sum = 0, product = 0;
    assert_non_null(x);
    for (size_t i = 0; i < N; i++) {
        x[i] = flow_draw_normal(7, i, FLOW_DRAW_WEAR);
        sum += x[i];
        product += x[i] * flow_draw_normal(7, i, FLOW_DRAW_PRESSURE);
    }
    assert_near_abs(sum / N, 0, 4 / sqrt(N));
    assert_near_abs(product / N, 0, 4 / sqrt(N));
    assert_near_abs(flow_standard_deviation(x, N, 1), 1, 4 / sqrt(2.0 * N));
    assert_near(flow_draw_normal(7, WT_NO_REPLICATE, FLOW_DRAW_WEAR), 0, 0);
    /* the seed has an effect */
    assert_true(fabs(flow_draw_normal(8, 0, FLOW_DRAW_WEAR) - x[0]) > 0);
    const double odd[] = {1, (double)NAN, 3, (double)NAN};
    assert_near(flow_standard_deviation(odd, 4, 1), sqrt(2), 1e-15);
    assert_near(flow_standard_deviation(odd, 2, 1), (double)NAN, 0);
    free(x);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_material_without_a_spectrum),
        cmocka_unit_test(test_bad_files),
        cmocka_unit_test(test_threads_and_rates),
        cmocka_unit_test(test_many_curves),
        cmocka_unit_test(test_spots),
        cmocka_unit_test(test_one_spot),
        cmocka_unit_test(test_rubber_at),
        cmocka_unit_test(test_rubber_at_reference),
        cmocka_unit_test(test_surface_text),
        cmocka_unit_test(test_surface_truncated),
        cmocka_unit_test(test_calibration),
        cmocka_unit_test(test_layer_numbers),
        cmocka_unit_test(test_draws),
    };
    return cmocka_run_group_tests_name("flow jobs", tests, open_formats, free_formats);
}
