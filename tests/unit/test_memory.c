/* When memory runs out: every job is run again and again, each time with one allocation failing,
 * one for each place (with those who called it) that allocates. It must say so, or give the same
 * result as without; the sanitizers see what is left behind. The linker puts the functions here
 * before those of the C library (see CMakeLists.txt).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "truth.h"

#include "core/store/store.h"
#include "dma_data.h"
#include "weartrack/case.h"

#include <execinfo.h>
#include <pthread.h>
#include <sys/stat.h>

enum { MAX_PLACES = 4096, OWN = 3, DEPTH = OWN + 4 };

/* ---- allocations ----------------------------------------------------------------------------- */

void *__real_malloc(size_t size);
void *__real_calloc(size_t n, size_t size);
void *__real_realloc(void *old, size_t size);
char *__real_strdup(const char *text);
char *__real_strndup(const char *text, size_t n);
FILE *__real_open_memstream(char **text, size_t *size);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t n, size_t size);
void *__wrap_realloc(void *old, size_t size);
char *__wrap_strdup(const char *text);
char *__wrap_strndup(const char *text, size_t n);
FILE *__wrap_open_memstream(char **text, size_t *size);

static bool counting;             /* allocations of the job, not of the test */
static size_t count;              /* of those so far */
static size_t failing;            /* number of the one that fails; SIZE_MAX = none */
static uint64_t seen[MAX_PLACES]; /* places found in the first run */
static size_t first_at[MAX_PLACES], n_seen;

/* A number for the place and its callers. */
__attribute__((noinline)) static uint64_t place(void)
{
    void *frames[DEPTH];
    uint64_t hash = 0;
    int n = backtrace(frames, DEPTH);
    for (int i = OWN; i < n; i++) /* this one, fails() and the allocator come before */
        hash = (hash ^ (uint64_t)(uintptr_t)frames[i]) * UINT64_C(0x9E3779B97F4A7C15);
    return hash;
}

__attribute__((noinline)) static bool fails(void)
{
    if (!counting)
        return false;
    const size_t number = count++;
    if (failing != SIZE_MAX)
        return number == failing;
    counting = false;
    const uint64_t here = place();
    counting = true;
    size_t i = 0;
    while (i < n_seen && seen[i] != here)
        i++;
    if (i == n_seen && n_seen < MAX_PLACES) {
        seen[n_seen] = here;
        first_at[n_seen++] = number;
    }
    return false;
}

void *__wrap_malloc(size_t size)
{
    return fails() ? NULL : __real_malloc(size);
}

void *__wrap_calloc(size_t n, size_t size)
{
    return fails() ? NULL : __real_calloc(n, size);
}

void *__wrap_realloc(void *old, size_t size)
{
    return fails() ? NULL : __real_realloc(old, size);
}

char *__wrap_strdup(const char *text)
{
    return fails() ? NULL : __real_strdup(text);
}

char *__wrap_strndup(const char *text, size_t n)
{
    return fails() ? NULL : __real_strndup(text, n);
}

FILE *__wrap_open_memstream(char **text, size_t *size)
{
    return fails() ? NULL : __real_open_memstream(text, size);
}

/* ---- a job under failing memory -------------------------------------------------------------- */

/* What is said when memory runs out: out of memory, or any failure where HDF5 or the system
 * are in between. */
typedef enum says { SAYS_MEMORY, SAYS_FAILURE } says;

/* Does the job; what it gave is written to `out`, which is NULL unless it went well. */
typedef wt_status job(FILE **out, wt_error *err);

static void write_table(FILE *out, const wt_table *table)
{
    counting = false;
    if (table != NULL && out != NULL && strcmp(wt_table_name(table), "cost") != 0)
        assert_int_equal(wt_stream_write(out, table, NULL, NULL), WT_OK);
}

/* What the job gives, in memory of the test; NULL if it fails. */
static char *run(job *j, wt_status *status, wt_error *err)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = __real_open_memstream(&text, &size);
    *err = (wt_error)WT_ERROR_INIT;
    count = 0;
    counting = true;
    *status = j(&out, err);
    counting = false;
    fclose(out);
    return text;
}

static void check_job(const char *name, job *j, says expected)
{
    wt_error err;
    wt_status status;
    size_t wrong = 0;
    n_seen = 0;
    failing = SIZE_MAX;
    char *good = run(j, &status, &err);
    if (status != WT_OK)
        fail_msg("%s: %s %s", name, err.message, err.found);
    print_message("%s: %zu allocations at %zu places\n", name, count, n_seen);
    assert_true(n_seen > 0 && n_seen < MAX_PLACES);
    for (size_t i = 0; i < n_seen; i++) {
        failing = first_at[i];
        char *text = run(j, &status, &err);
        bool same = status == WT_OK && strcmp(text, good) == 0;
        bool said = expected == SAYS_MEMORY ? status == WT_E_MEMORY : status != WT_OK;
        if (!said && !same) {
            print_error("%s: allocation %zu fails: %s: %s\n", name, failing,
                        status == WT_OK ? "another result" : wt_status_text(status), err.message);
            wrong++;
        }
        free(text);
    }
    free(good);
    assert_int_equal(wrong, 0);
}

/* ---- jobs ------------------------------------------------------------------------------------ */

static char folder[] = "/tmp/weartrack-memory-XXXXXX", curves[64], sweeps[64], store[64], text[64],
            report[64], program[64];

static wt_status indent(FILE **out, wt_error *err)
{
    const char *const patterns[] = {curves};
    wt_file_set set = {.patterns = patterns, .n_patterns = 1, .read = wt_read_defaults()};
    wt_indent_job j = wt_indent_job_defaults();
    wt_job common = wt_job_defaults();
    wt_indent_tables tables = {0};
    wt_formats *formats = NULL;
    wt_status status = wt_formats_new(NULL, &formats, NULL, err);
    if (status == WT_OK)
        status = wt_tip_parse(HERTZ_TIP, &j.tip, err);
    j.sets = &set;
    j.n_sets = 1;
    j.median_curve = true;
    common.formats = formats;
    common.threads = 1;
    if (status == WT_OK)
        status = wt_indent_group(&j, &common, &tables, err);
    write_table(*out, tables.indentation);
    write_table(*out, tables.force_displacement);
    write_table(*out, tables.force_indentation);
    wt_indent_tables_clear(&tables);
    wt_formats_free(formats);
    return status;
}

static wt_status master(FILE **out, wt_error *err)
{
    const char *const patterns[] = {sweeps};
    wt_file_set set = {.patterns = patterns, .n_patterns = 1, .read = wt_read_defaults()};
    wt_master_job j = wt_master_job_defaults();
    wt_job common = wt_job_defaults();
    wt_master_tables tables = {0};
    wt_rubber rubber = {0};
    wt_material *material = NULL;
    wt_formats *formats = NULL;
    wt_status status = wt_formats_new(NULL, &formats, NULL, err);
    j.sets = &set;
    j.n_sets = 1;
    common.formats = formats;
    common.threads = 1;
    if (status == WT_OK)
        status = wt_master_compute(&j, &common, &tables, &rubber, err);
    if (status == WT_OK)
        status = wt_rubber_material(&rubber, 300, 1, 0, &material, NULL, err);
    write_table(*out, tables.shift_factors);
    write_table(*out, tables.master_curve);
    write_table(*out, tables.prony);
    wt_material_free(material);
    wt_master_tables_clear(&tables);
    wt_rubber_clear(&rubber);
    wt_formats_free(formats);
    return status;
}

static const char case_text[] =
    "<case version=\"1\"><title>t</title>"
    "<dma><reference-temperature>20degC</reference-temperature><prony deformation=\"tension\" "
    "frequency-min=\"1e-2rad/s\" frequency-max=\"1e8rad/s\"><equilibrium>2MPa</equilibrium>"
    "<term time=\"1e-4s\" modulus=\"30MPa\"/></prony><wlf><c1>6.5</c1><c2>110K</c2></wlf></dma>"
    "<roughness><self-affine><q0>2e3rad/m</q0><qr>4e3rad/m</qr><q1>2e4rad/m</q1>"
    "<hurst>0.8</hurst><c0>2e-17m^4 +- 5%</c0></self-affine></roughness>"
    "<sliding><pressure>0.4MPa</pressure><velocity>1mm/s,1cm/s</velocity>"
    "<temperature>30degC</temperature><shear-stress>5MPa</shear-stress></sliding>"
    "<layer><specific-wear-rate>1e-3mm^3/(N m)</specific-wear-rate>"
    "<critical-energy>1e9J/m^3</critical-energy><modulus-ratio>0.6</modulus-ratio></layer></case>";

static wt_status run_case(FILE **out, wt_error *err)
{
    wt_case *c = NULL;
    wt_result *result = NULL;
    wt_table *plan = NULL;
    wt_run_options options = wt_run_defaults();
    size_t n_failed = 0;
    options.threads = 1;
    options.replicates = 2;
    options.tolerance = 1e-3;
    options.no_provenance = true;
    wt_status status = wt_case_read(text, &c, err);
    if (status == WT_OK)
        status = wt_plan(c, &plan, err);
    if (status == WT_OK)
        status = wt_run_case(c, &options, NULL, &result, &n_failed, err);
    write_table(*out, plan);
    for (size_t i = 0; status == WT_OK && i < wt_result_n_tables(result); i++)
        write_table(*out, wt_result_table(result, i));
    wt_result_free(result);
    wt_table_free(plan);
    wt_case_free(c);
    return status;
}

static wt_status take_table(void *user, wt_table *table, wt_error *err)
{
    (void)err;
    write_table(user, table);
    wt_table_free(table);
    counting = true;
    return WT_OK;
}

/* One file of each reader. */
static const char *converted;

static wt_status convert(FILE **out, wt_error *err)
{
    wt_convert_job j = wt_convert_job_defaults();
    wt_job common = wt_job_defaults();
    wt_formats *formats = NULL;
    wt_status status = wt_formats_new(NULL, &formats, NULL, err);
    common.formats = formats;
    common.log = wt_log_new();
    common.provenance = wt_provenance_new();
    if (common.log == NULL || common.provenance == NULL)
        status = WT_E_MEMORY;
    if (status == WT_OK)
        status = wt_convert_file(&j, converted, &common, take_table, NULL, *out, err);
    wt_provenance_free(common.provenance);
    wt_log_free(common.log);
    wt_formats_free(formats);
    return status;
}

/* A result of two tables, written and read again. */
static wt_status make_result(wt_result **result, wt_error *err)
{
    wt_table *t = wt_table_new("energy_density", "Energy density");
    wt_status status = t == NULL ? WT_E_MEMORY : WT_OK;
    *result = wt_result_new();
    if (*result == NULL)
        status = WT_E_MEMORY;
    if (status == WT_OK)
        status = wt_table_add_column(t, "depth", "m", "depth below the surface", err);
    if (status == WT_OK)
        status = wt_table_add_column(t, "energy_density", "W/m^3", "power", err);
    for (int i = 0; status == WT_OK && i < 5; i++) {
        status = wt_table_add_row(t, err);
        if (status == WT_OK) {
            wt_table_set_number(t, 0, 1e-6 * pow(2, i));
            wt_table_set_number(t, 1, 1e9 / (i + 1));
        }
    }
    wt_estimate velocity = {0.3, 0.01, 0, "m/s"};
    if (status == WT_OK)
        status = wt_table_set_estimate(t, "velocity", velocity, err);
    if (status == WT_OK) {
        status = wt_result_add(*result, t, err);
        t = NULL;
    }
    wt_table_free(t);
    if (status == WT_OK)
        status = wt_result_set_case(*result, case_text, sizeof case_text - 1, err);
    return status;
}

static wt_status write_store(FILE **out, wt_error *err)
{
    wt_result *result = NULL, *again = NULL;
    wt_status status = make_result(&result, err);
    if (status == WT_OK)
        status = wt_store_write(store, result, true, err);
    if (status == WT_OK)
        status = wt_store_read(store, &again, err);
    if (status == WT_OK)
        write_table(*out, wt_result_find(again, "energy_density"));
    wt_result_free(result);
    wt_result_free(again);
    return status;
}

/* What is done behind the door to HDF5, in front of it. */
static wt_status pass_store(FILE **out, wt_error *err)
{
    char *passed = NULL;
    size_t size = 0;
    FILE *const answer = __real_open_memstream(&passed, &size);
    const hid_t file = H5Fopen(store, H5F_ACC_RDONLY, H5P_DEFAULT);
    const wt_status status = store_extract(file, (size_t)1 << 20, answer, err);
    counting = false;
    (void)H5Fclose(file);
    (void)fclose(answer);
    if (status == WT_OK)
        (void)fwrite(passed, 1, strlen(passed), *out);
    free(passed);
    return status;
}

/* The page; what stands for gnuplot makes an empty picture. */
static wt_status write_report(FILE **out, wt_error *err)
{
    wt_report_options options = wt_report_defaults();
    wt_result *result = NULL;
    char path[128];
    wt_status status = make_result(&result, err);
    options.gnuplot = program;
    options.with_provenance = false;
    if (status == WT_OK)
        status = wt_report_write(result, report, &options, NULL, err);
    counting = false;
    wt_result_free(result);
    snprintf(path, sizeof path, "%s/index.html", report);
    FILE *page = status == WT_OK ? fopen(path, "r") : NULL;
    for (int c; page != NULL && (c = fgetc(page)) != EOF;)
        fputc(c, *out);
    if (page != NULL)
        fclose(page);
    return status;
}

/* ---- tests ----------------------------------------------------------------------------------- */

/* A process of its own counts for itself. */
static void not_here(void)
{
    counting = false;
}

static int set_up(void **state)
{
    (void)state;
    if (pthread_atfork(NULL, NULL, not_here) != 0)
        return -1;
    if (mkdtemp(folder) == NULL)
        return -1;
    snprintf(curves, sizeof curves, "%s/curves.tsv", folder);
    snprintf(sweeps, sizeof sweeps, "%s/sweeps.tsv", folder);
    snprintf(store, sizeof store, "%s/result.h5", folder);
    snprintf(text, sizeof text, "%s/case.xml", folder);
    snprintf(report, sizeof report, "%s/report", folder);
    FILE *out = fopen(curves, "w");
    hertz h = hertz_standard();
    hertz_write(out, &h, 0);
    h.modulus *= 1.1;
    hertz_write(out, &h, 1);
    fclose(out);
    out = fopen(sweeps, "w");
    fputs("## table: sweep\n# "
          "angular_frequency[rad/s]\tstorage_modulus[Pa]\tloss_modulus[Pa]\ttemperature[K]\n",
          out);
    for (int i = 0; i < 4; i++) {
        double t = 278.15 + 10 * i, step = t - 293.15;
        for (int k = 0; k < 8; k++) {
            double omega = pow(10, 0.3 * k), storage, loss;
            dma_moduli(&dma_rubber, omega * pow(10, -8 * step / (110 + step)), &storage, &loss);
            fprintf(out, "%.17g\t%.17g\t%.17g\t%.17g\n", omega, storage, loss, t);
        }
        fputc('\n', out);
    }
    fclose(out);
    out = fopen(text, "w");
    fputs(case_text, out);
    fclose(out);
    snprintf(program, sizeof program, "%s/plot", folder);
    out = fopen(program, "w");
    fputs(
        "#!/bin/sh\nfor f; do case $f in *.gp) "
        "echo '<svg xmlns=\"http://www.w3.org/2000/svg\"></svg>' >\"${f%.gp}.svg\";; esac; done\n",
        out);
    fclose(out);
    if (chmod(program, 0700) != 0)
        return -1;
    void *frame;
    return backtrace(&frame, 1) == 1 ? 0 : -1; /* its own allocations are done now */
}

static int clean(void **state)
{
    (void)state;
    char command[128];
    snprintf(command, sizeof command, "rm -r '%s'", folder);
    return system(command);
}

static void test_indent(void **state)
{
    (void)state;
    check_job("indent", indent, SAYS_MEMORY);
}

static void test_master(void **state)
{
    (void)state;
    check_job("master", master, SAYS_MEMORY);
}

static void test_run(void **state)
{
    (void)state;
    check_job("run", run_case, SAYS_MEMORY);
}

static void test_convert(void **state)
{
    (void)state;
    static const char *const files[] = {"fuzz/jpk/seed0.zip", "fuzz/nid/seed0.nid",
                                        "formats/tidy/two-runs.csv",
                                        "formats/table-spectrum/surface.txt"};
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        char path[512];
        snprintf(path, sizeof path, WT_SOURCE_DIR "/fixtures/%s", files[i]);
        converted = path;
        check_job(files[i], convert, SAYS_MEMORY);
    }
}

static void test_store(void **state)
{
    (void)state;
    check_job("store", write_store, SAYS_FAILURE);
    check_job("behind the door", pass_store, SAYS_MEMORY);
}

static void test_report(void **state)
{
    (void)state;
    check_job("report", write_report, SAYS_FAILURE);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_indent), cmocka_unit_test(test_master),
        cmocka_unit_test(test_run),    cmocka_unit_test(test_convert),
        cmocka_unit_test(test_store),  cmocka_unit_test(test_report),
    };
    return cmocka_run_group_tests_name("memory", tests, set_up, clean);
}
