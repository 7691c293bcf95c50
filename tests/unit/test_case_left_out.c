/* Parts of a case that are not requested cost nothing. For every table and figure the test counts
 * opened files, read bytes, decoded channels, stages and inner computations. The linker puts the
 * counters around the functions (see CMakeLists.txt), so the library has none.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/system/temporary.h"
#include "table_cells.h"

#include "case/plan/plan.h"
#include "core/math/root.h"
#include "dma/master.h"
#include "dma/numerics/spectrum.h"
#include "friction/numerics/friction_kernel.h"
#include "indentation/numerics/curve.h"
#include "layer/numerics/layer_kernel.h"
#include "read/bytes/samples.h"
#include "weartrack/case.h"

#include <fcntl.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* ---- files ----------------------------------------------------------------------------------- */

#define CASE WT_SOURCE_DIR "/fixtures/case/"
enum { MOST_FILES = 64 };

typedef struct seen_file {
    char path[512];
    size_t opened, bytes; /* opened for reading; the search for copies only reads the ends */
    int descriptor;
    bool is_read; /* reads through the descriptor */
} seen_file;

static seen_file seen[MOST_FILES];
static size_t n_seen;

/* Counts files of the case; system files are not inputs. */
static seen_file *find_seen(const char *path)
{
    for (size_t i = 0; i < n_seen; i++)
        if (strcmp(seen[i].path, path) == 0)
            return &seen[i];
    assert_true(n_seen < MOST_FILES);
    seen_file *f = &seen[n_seen++];
    *f = (seen_file){.descriptor = -1};
    snprintf(f->path, sizeof f->path, "%s", path);
    return f;
}

int __real_open(const char *path, int flags, ...);
int __wrap_open(const char *path, int flags, ...);
int __wrap_open(const char *path, int flags, ...)
{
    va_list list;
    va_start(list, flags);
    const unsigned mode = (flags & O_CREAT) != 0 ? va_arg(list, unsigned) : 0;
    va_end(list);
    const int descriptor = __real_open(path, flags, mode);
    if (descriptor >= 0 && (flags & O_ACCMODE) == O_RDONLY) {
        seen_file *f = find_seen(path);
        f->descriptor = descriptor;
        f->is_read = false;
    }
    return descriptor;
}

ssize_t __real_read(int descriptor, void *buffer, size_t n);
ssize_t __wrap_read(int descriptor, void *buffer, size_t n);
ssize_t __wrap_read(int descriptor, void *buffer, size_t n)
{
    const ssize_t got = __real_read(descriptor, buffer, n);
    for (size_t i = 0; got > 0 && i < n_seen; i++)
        if (seen[i].descriptor == descriptor) {
            seen[i].opened += !seen[i].is_read;
            seen[i].is_read = true;
            seen[i].bytes += (size_t)got;
        }
    return got;
}

int __real_close(int descriptor);
int __wrap_close(int descriptor);
int __wrap_close(int descriptor)
{
    for (size_t i = 0; i < n_seen; i++)
        if (seen[i].descriptor == descriptor)
            seen[i].descriptor = -1;
    return __real_close(descriptor);
}

/* ---- inner work ------------------------------------------------------------------------------ */

typedef enum work {
    CHANNELS,   /* decoded, of one segment each */
    CURVES,     /* fitted */
    MASTERS,    /* fits of isotherms */
    DRAWS,      /* of a material from them */
    DEPTHS,     /* moduli against depth */
    WORKSPACES, /* contacts with a counter surface */
    PASSES,     /* of the friction integral */
    SHARES,     /* passes with the extrapolated share */
    PROFILES,   /* contact area against magnification */
    SOURCES_OF, /* energy of the layer */
    DENSITIES,  /* energy density at a depth */
    BALANCES,
    HISTORIES,
    TIMES,    /* of the layer, to a thickness */
    REACHES,  /* numerical errors of its thicknesses */
    VERDICTS, /* on superposition */
    DIGESTS,  /* SHA-256 */
    AGAIN,    /* curves fitted, those drawn anew among them */
    SPECTRA,  /* relaxation spectra with their intervals */
    FEW,      /* reductions to few terms */
    PEAKS,    /* of temperature sweeps */
    BETWEEN,  /* moduli at a temperature */
    SOFTENED, /* laws of strain sweeps */
    SURFACES, /* tables of the counter surface */
    N_WORK
} work;

static const char *const work_names[N_WORK] = {"channels decoded",
                                               "curves fitted",
                                               "fits of isotherms",
                                               "draws of the material",
                                               "moduli against depth",
                                               "contacts",
                                               "passes of the friction integral",
                                               "extrapolated shares",
                                               "contact profiles",
                                               "energy sources",
                                               "energy densities",
                                               "balances",
                                               "histories",
                                               "times to a thickness",
                                               "errors of a thickness",
                                               "verdicts on superposition",
                                               "digests",
                                               "fits of curves",
                                               "relaxation spectra",
                                               "reduced series",
                                               "peaks",
                                               "moduli at temperatures",
                                               "laws of softening",
                                               "tables of the surface"};
static atomic_size_t count[N_WORK];

/* Declares, counts and calls the function. */
#define COUNTED(type, name, which, parameters, arguments)                                          \
    type __real_##name parameters;                                                                 \
    type __wrap_##name parameters;                                                                 \
    type __wrap_##name parameters                                                                  \
    {                                                                                              \
        count[which]++;                                                                            \
        return __real_##name arguments;                                                            \
    }

void __real_samples_decode(sample_type type, bool big_endian, const unsigned char *bytes, size_t n,
                           double multiplier, double offset, double *values);
void __wrap_samples_decode(sample_type type, bool big_endian, const unsigned char *bytes, size_t n,
                           double multiplier, double offset, double *values);
void __wrap_samples_decode(sample_type type, bool big_endian, const unsigned char *bytes, size_t n,
                           double multiplier, double offset, double *values)
{
    count[CHANNELS]++;
    __real_samples_decode(type, big_endian, bytes, n, multiplier, offset, values);
}

COUNTED(wt_status, wt_indent_fit_force_curve, CURVES,
        (const wt_contact_table *contact, const wt_indent_options *options,
         const wt_force_curve *curve, wt_indent_workspace *workspace, wt_indent_fit *fit,
         wt_error *err),
        (contact, options, curve, workspace, fit, err))
COUNTED(wt_status, wt_master_fit, MASTERS,
        (const wt_sweep *sweep, const wt_master_options *options, wt_log *log, wt_master *master,
         wt_error *err),
        (sweep, options, log, master, err))
COUNTED(wt_status, wt_master_draw, DRAWS,
        (const wt_master *master, uint64_t seed, size_t draw, wt_prony *prony, wt_shift_law *law,
         double *log_b, wt_error *err),
        (master, seed, draw, prony, law, log_b, err))
COUNTED(wt_status, wt_modulus_profile_fit, DEPTHS,
        (const wt_contact_table *contact, double poisson_ratio, const wt_curve_residuals *curves,
         size_t n, wt_modulus_profile *depth, wt_error *err),
        (contact, poisson_ratio, curves, n, depth, err))
COUNTED(wt_status, wt_friction_workspace_new, WORKSPACES,
        (const wt_material *material, const wt_roughness *roughness,
         const wt_friction_options *options, wt_friction_workspace **workspace, wt_error *err),
        (material, roughness, options, workspace, err))
COUNTED(wt_status, wt_friction_profile, PROFILES,
        (wt_friction_workspace * workspace, double pressure, double velocity,
         const double *wavenumber, size_t n, wt_friction_node *nodes, wt_error *err),
        (workspace, pressure, velocity, wavenumber, n, nodes, err))
COUNTED(wt_status, wt_energy_source_from_friction, SOURCES_OF,
        (wt_friction_workspace * workspace, double pressure, double velocity,
         wt_energy_source *source, wt_error *err),
        (workspace, pressure, velocity, source, err))
COUNTED(double, wt_energy_density, DENSITIES, (const wt_energy_source *source, double depth),
        (source, depth))
COUNTED(wt_status, wt_layer_steady_state_compute, BALANCES,
        (const wt_energy_source *source, const wt_layer_parameters *parameters,
         wt_layer_steady_state *balance, wt_error *err),
        (source, parameters, balance, err))
COUNTED(wt_status, wt_layer_history, HISTORIES,
        (const wt_energy_source *source, const wt_layer_parameters *parameters, const double *time,
         size_t n, wt_layer_point *points, wt_error *err),
        (source, parameters, time, n, points, err))
COUNTED(wt_status, layer_damage_time, TIMES,
        (const layer_rates *rates, bool with_wear, wt_estimate depth, wt_estimate *time,
         wt_error *err),
        (rates, with_wear, depth, time, err))
COUNTED(double, root_displacement, REACHES,
        (root_fn function, void *user, double root, double error, double reach, double least),
        (function, user, root, error, reach, least))
COUNTED(lack_of_fit, superposition_test, VERDICTS, (const spectrum *s, double uncertainty),
        (s, uncertainty))
COUNTED(wt_status, curve_fit_branches, AGAIN,
        (const wt_contact_table *table, const wt_indent_options *options,
         const curve_branch *approach, const curve_branch *retract, double spring_constant,
         wt_indent_workspace *workspace, wt_indent_fit *fit, wt_error *err),
        (table, options, approach, retract, spring_constant, workspace, fit, err))
COUNTED(wt_status, flow_spectrum_table, SPECTRA,
        (const wt_master *m, wt_table **table, wt_error *err), (m, table, err))
COUNTED(wt_status, wt_prony_reduce, FEW,
        (const wt_prony *from, const wt_reduction *how, wt_prony *prony, wt_error *err),
        (from, how, prony, err))
COUNTED(wt_status, wt_peak_find, PEAKS,
        (const double *x, const double *y, size_t n, wt_peak *peak, wt_error *err),
        (x, y, n, peak, err))
COUNTED(wt_status, wt_smooth_interpolate, BETWEEN,
        (const double *x, const double *y, size_t n, double at, wt_interval *value, wt_error *err),
        (x, y, n, at, value, err))
COUNTED(wt_status, wt_payne_measure, SOFTENED,
        (const double *strain, const double *storage, const double *loss, size_t n, wt_payne *payne,
         wt_error *err),
        (strain, storage, loss, n, payne, err))
COUNTED(wt_status, wt_surface_table, SURFACES,
        (const wt_surface *surface, wt_table **table, wt_error *err), (surface, table, err))
void __real_wt_sha256(const void *bytes, size_t length, char hex[65]);
void __wrap_wt_sha256(const void *bytes, size_t length, char hex[65]);
void __wrap_wt_sha256(const void *bytes, size_t length, char hex[65])
{
    count[DIGESTS]++;
    __real_wt_sha256(bytes, length, hex);
}
wt_status __real_digest_stream(digest_source *source, void *user, size_t length, char hex[65],
                               uint64_t *fingerprint, wt_error *err);
wt_status __wrap_digest_stream(digest_source *source, void *user, size_t length, char hex[65],
                               uint64_t *fingerprint, wt_error *err);
wt_status __wrap_digest_stream(digest_source *source, void *user, size_t length, char hex[65],
                               uint64_t *fingerprint, wt_error *err)
{
    count[DIGESTS] += hex != NULL;
    return __real_digest_stream(source, user, length, hex, fingerprint, err);
}

void __real_friction_evaluate(const wt_friction_workspace *ws, friction_scratch *scratch,
                              const subinterval_plan *plan, friction_effort effort,
                              friction_load at, bool with_outside, node_contributions *record,
                              friction_pass *pass);
void __wrap_friction_evaluate(const wt_friction_workspace *ws, friction_scratch *scratch,
                              const subinterval_plan *plan, friction_effort effort,
                              friction_load at, bool with_outside, node_contributions *record,
                              friction_pass *pass);
void __wrap_friction_evaluate(const wt_friction_workspace *ws, friction_scratch *scratch,
                              const subinterval_plan *plan, friction_effort effort,
                              friction_load at, bool with_outside, node_contributions *record,
                              friction_pass *pass)
{
    count[PASSES]++;
    count[SHARES] += with_outside;
    __real_friction_evaluate(ws, scratch, plan, effort, at, with_outside, record, pass);
}

/* ---- one run --------------------------------------------------------------------------------- */

typedef struct ran {
    wt_case *c;
    flow_plan plan;
    wt_result *result;
    size_t replicates;
    bool provenance;
} ran;

/* Writes `case_file` with the requested elements in place of its <report>. */
static wt_case *case_that_asks(const char *asks)
{
    char path[] = CASE "asks-XXXXXX";
    char *text = NULL, *end;
    size_t length = 0;
    wt_error err = WT_ERROR_INIT;
    wt_case *c = NULL;
    FILE *in = fopen(CASE "case.xml", "r");
    assert_non_null(in);
    assert_true(getdelim(&text, &length, '\0', in) > 0);
    fclose(in);
    end = strstr(text, "<report");
    assert_non_null(end);
    *end = '\0';
    char *dma = strstr(text, "<files>dma.txt"); /* the moduli are stated at a temperature */
    assert_non_null(dma);
    const int file = mkstemp(path);
    assert_true(file >= 0);
    /* softening needs strain sweeps, which the case does not have */
    const bool strain = strstr(asks, "payne") != NULL;
    dprintf(file, "%.*s<at>25degC</at>%s%s<report>%s</report></case>", (int)(dma - text), text,
            strain ? "<files>" WT_SOURCE_DIR "/fixtures/formats/tidy/strain-sweeps.csv</files>"
                   : "",
            strain ? strstr(dma, "</files>") + strlen("</files>") : dma, asks);
    close(file);
    const wt_status status = wt_case_read(path, &c, &err);
    unlink(path);
    free(text);
    if (status != WT_OK)
        fail_msg("%s: %s %s", asks, err.message, err.found);
    return c;
}

static ran run(const char *asks, size_t replicates, bool provenance)
{
    ran r = {.c = case_that_asks(asks), .replicates = replicates, .provenance = provenance};
    wt_run_options options = wt_run_defaults();
    wt_error err = WT_ERROR_INIT;
    size_t n_failed = 0;
    options.threads = 1;
    options.tolerance = 1e-3;
    options.replicates = replicates;
    options.no_provenance = !provenance;
    flow_plan_create(r.c, &r.plan);
    n_seen = 0;
    for (int i = 0; i < N_WORK; i++)
        count[i] = 0;
    if (wt_run_case(r.c, &options, NULL, &r.result, &n_failed, &err) != WT_OK || n_failed > 0)
        fail_msg("%s: %s %s", asks, err.message, err.found);
    return r;
}

static void release(ran *r)
{
    wt_result_free(r->result);
    wt_case_free(r->c);
}

static bool runs(const ran *r, flow_resource given)
{
    for (size_t i = 0; i < FLOW_N_STAGES; i++)
        if (r->plan.chosen[i] && (flow_stages[i].outputs & FLOW_BIT(given)) != 0)
            return true;
    return false;
}

static bool shown(const ran *r, flow_resource table)
{
    return (r->plan.required & FLOW_BIT(table)) != 0;
}

/* ---- checks ---------------------------------------------------------------------------------- */

static void check_stages(const char *asks, const ran *r)
{
    const wt_table *cost = wt_result_find(r->result, "cost");
    assert_int_equal(wt_table_n_rows(cost), FLOW_N_STAGES);
    for (size_t i = 0; i < FLOW_N_STAGES; i++)
        if ((number_cell(cost, i, "runs") > 0) != r->plan.chosen[i])
            fail_msg("%s: stage %s %s, the plan says otherwise", asks, flow_stages[i].id,
                     r->plan.chosen[i] ? "did not run" : "ran");
}

/* Each file of a requested kind is read once and completely, others not at all. */
static size_t check_kind(const char *asks, const char *pattern, bool needed, bool median)
{
    char **paths = NULL;
    size_t n = 0, again = 0;
    assert_int_equal(wt_glob(WT_SOURCE_DIR "/fixtures/case", pattern, &paths, &n, NULL), WT_OK);
    for (size_t i = 0; i < n; i++) {
        struct stat info;
        size_t opened = 0, bytes = 0;
        assert_int_equal(stat(paths[i], &info), 0);
        for (size_t k = 0; k < n_seen; k++)
            if (strcmp(seen[k].path, paths[i]) == 0) {
                opened = seen[k].opened;
                bytes = seen[k].bytes;
            }
        if (median && opened == 2) {
            again++;
            opened = 1;
            bytes /= 2;
        }
        if (opened != needed || bytes != (needed ? (size_t)info.st_size : 0))
            fail_msg("%s: %s was opened %zu times, %zu of its %zu bytes were read", asks, paths[i],
                     opened, bytes, (size_t)info.st_size);
    }
    wt_strings_free(paths, n);
    assert_int_equal(again, median);
    return needed ? n : 0;
}

static void check_files(const char *asks, const ran *r)
{
    const bool bulk = runs(r, FLOW_INDENTATION_BULK), track = runs(r, FLOW_INDENTATION_TRACK);
    size_t n = check_kind(asks, "bulk-*", bulk, bulk && shown(r, FLOW_CURVE_BULK));
    n += check_kind(asks, "track-*", track, track && shown(r, FLOW_CURVE_TRACK));
    n += check_kind(asks, "dma.txt", runs(r, FLOW_PRONY) || runs(r, FLOW_RAMP), false);
    n += check_kind(asks, "road-*", runs(r, FLOW_SURFACE), false);
    size_t inputs = 0;
    for (size_t i = 0; i < n_seen; i++)
        inputs += strncmp(seen[i].path, CASE, strlen(CASE)) == 0 && seen[i].bytes > 0;
    if (inputs != n)
        fail_msg("%s: %zu inputs were read, %zu are needed", asks, inputs, n);
}

static void check(const char *asks, work which, size_t expected)
{
    if (count[which] != expected)
        fail_msg("%s: %s: %zu, needed %zu", asks, work_names[which], (size_t)count[which],
                 expected);
}

static void check_some(const char *asks, work which, bool needed)
{
    if ((count[which] > 0) != needed)
        fail_msg("%s: %s: %zu, %s", asks, work_names[which], (size_t)count[which],
                 needed ? "some are needed" : "none are needed");
}

enum { LINES_OF_MAPS = 2 * (192 + 224) };
enum { CURVES_OF_A_FILE = 12, FILES_OF_A_GROUP = 4, DEPTHS_SHOWN = 121, TIMES_SHOWN = 61 };
enum { ISOTHERMS_LEFT_OUT = 12 }; /* one by one, with a fit each */

static void check_curves(const char *asks, const ran *r)
{
    /* approach and retract with height and deflection; time is no channel here */
    const size_t channels = 4, fitted = CURVES_OF_A_FILE * FILES_OF_A_GROUP;
    const size_t groups = (size_t)runs(r, FLOW_INDENTATION_BULK) + runs(r, FLOW_INDENTATION_TRACK);
    const bool again = shown(r, FLOW_CURVE_BULK) || shown(r, FLOW_CURVE_TRACK);
    /* each line of a height map is decoded like a channel */
    const size_t lines = runs(r, FLOW_SURFACE) ? LINES_OF_MAPS : (size_t)0;
    if (!again) {
        check(asks, CURVES, groups * fitted);
        check(asks, CHANNELS, channels * groups * fitted + lines);
    } else { /* the representative curve, and those before it in its file */
        check(asks, CURVES, groups * (fitted + 1));
        assert_true(count[CHANNELS] > channels * groups * fitted + lines &&
                    count[CHANNELS] <= channels * groups * (fitted + CURVES_OF_A_FILE) + lines);
    }
    /* With a stated error of the cantilever at most 8 curves, here every eighth, are fitted again
     * with four error sources moved down and up, and the first of them with three more. */
    const size_t moved = (fitted / 8 * 4 + 3) * 2;
    const bool common = shown(r, FLOW_MODULUS_GROUPS) || shown(r, FLOW_MODULUS_BUDGET) ||
                        shown(r, FLOW_COMPARISON) || shown(r, FLOW_MODULUS_RATIO);
    check(asks, AGAIN, count[CURVES] + (common ? groups * moved : 0));
    check(asks, DEPTHS,
          (size_t)shown(r, FLOW_DEPTH_BULK) + (size_t)shown(r, FLOW_DEPTH_TRACK) +
              2 * (size_t)runs(r, FLOW_TRACK_LAYER));
}

static void check_material(const char *asks, const ran *r)
{
    const bool drawn = shown(r, FLOW_MATERIAL_DRAWS) || shown(r, FLOW_SERIES_DRAWS) ||
                       runs(r, FLOW_COMPARISON) || runs(r, FLOW_DMA_COMPARISON) ||
                       (r->replicates > 0 && (runs(r, FLOW_LAYER) || runs(r, FLOW_FRICTION) ||
                                              runs(r, FLOW_ERROR_BUDGET)));
    /* The choice of the vertical shift needs a fit with each of the three others. Error against run
     * time needs a fit for many draws. */
    const size_t precision = runs(r, FLOW_WORK_PRECISION);
    check(asks, MASTERS,
          runs(r, FLOW_PRONY) + 3 * (size_t)runs(r, FLOW_WHAT_IF) + precision +
              ISOTHERMS_LEFT_OUT * (size_t)shown(r, FLOW_INFLUENCES));
    check(asks, VERDICTS, (size_t)runs(r, FLOW_PRONY));
    check(asks, DRAWS, 200 * drawn + 4000 * precision);
}

/* Results of the DMA that the other stages do not use. */
static void check_dma(const char *asks, const ran *r)
{
    check(asks, SPECTRA, shown(r, FLOW_RELAXATION_SPECTRUM));
    check(asks, FEW, shown(r, FLOW_PRONY_REDUCED));
    check_some(asks, PEAKS, shown(r, FLOW_GLASS_TRANSITION));
    check_some(asks, BETWEEN, shown(r, FLOW_MODULI_AT));
    check_some(asks, SOFTENED, runs(r, FLOW_PAYNE));
    check(asks, SURFACES, shown(r, FLOW_ROUGHNESS));
}

static void check_sliding(const char *asks, const ran *r)
{
    const size_t layer = runs(r, FLOW_LAYER), friction = runs(r, FLOW_FRICTION);
    const size_t area = shown(r, FLOW_CONTACT_AREA), density = shown(r, FLOW_ENERGY_DENSITY);
    const bool settings = runs(r, FLOW_WHAT_IF); /* the error budget needs it */
    const bool timed = runs(r, FLOW_WORK_PRECISION);
    const size_t times = 1 + r->replicates;
    check(asks, DENSITIES, density > 0 ? DEPTHS_SHOWN : 0);
    check(asks, PROFILES, 3 * area);
    check_some(asks, SHARES, friction > 0 || settings);
    /* the errors are those of the values */
    if (!settings && !timed && count[REACHES] > layer * (1 + TIMES_SHOWN))
        fail_msg("%s: %s: %zu", asks, work_names[REACHES], (size_t)count[REACHES]);
    check(asks, TIMES, 2 * times * layer); /* incubation, and time to 90 % */
    check_some(asks, PASSES, layer + friction + area + density > 0 || settings || timed);
    if (settings || timed)
        return;
    check(asks, WORKSPACES, times * (layer + 2 * friction) + area + density);
    check(asks, SOURCES_OF, times * layer + density);
    check(asks, BALANCES, times * layer);
    check(asks, HISTORIES, times * layer);
}

static void check_asked(const char *element, const char *name, size_t replicates)
{
    char asks[160];
    snprintf(asks, sizeof asks, "<%s>%s</%s>", element, name, element);
    ran r = run(asks, replicates, false);
    check_stages(asks, &r);
    check_files(asks, &r);
    check_curves(asks, &r);
    check_material(asks, &r);
    check_dma(asks, &r);
    check_sliding(asks, &r);
    check(asks, DIGESTS, 0);
    release(&r);
}

/* Tables of every result. */
static bool is_of_run(const char *table)
{
    flow_resource_set things;
    return flow_table_resources(table, &things) && things == 0;
}

static void check_tables(size_t replicates)
{
    for (unsigned t = FLOW_FIRST_TABLE; t < FLOW_FIRST_INNER; t++)
        if (flow_resource_rows[t].schema != NULL)
            check_asked("result", flow_resource_rows[t].label, replicates);
    check_asked("result", "modulus_depth", replicates);
    check_asked("result", "force_indentation", replicates);
    check_asked("result", "cost", replicates);
}

static void test_tables(void **state)
{
    (void)state;
    check_tables(0);
}

static void test_tables_with_replicates(void **state)
{
    (void)state;
    check_tables(3);
}

static void test_figures(void **state)
{
    (void)state;
    for (size_t i = 0; i < wt_figure_count(); i++) {
        const wt_figure_info figure = wt_figure_get(i);
        flow_resource_set things;
        if (flow_figure_resources(figure.name, &things) && !is_of_run(figure.table))
            check_asked("figure", figure.name, 0);
    }
}

/* A digest of each file and of the case, none without provenance; copies are detected without a
 * digest. */
static void test_digests(void **state)
{
    (void)state;
    ran r = run("<result>prony</result>", 0, true);
    const wt_table *inputs = wt_result_find(r.result, "inputs");
    check("prony", DIGESTS, 2);
    assert_int_equal(wt_table_n_rows(inputs), 2);
    assert_int_equal(strlen(text_cell(inputs, 1, "sha256")), 64);
    release(&r);
    r = run("<result>prony</result>", 0, false);
    inputs = wt_result_find(r.result, "inputs");
    check("prony", DIGESTS, 0);
    assert_string_equal(text_cell(inputs, 1, "sha256"), "");
    release(&r);
}

/* Error budget and variants use no velocities, profile, density or history except that of the
 * start, and the share once. */
static void test_settings(void **state)
{
    (void)state;
    ran r = run("<result>what_if</result>", 0, false);
    const size_t rows = wt_table_n_rows(wt_result_find(r.result, "what_if"));
    check("what_if", WORKSPACES, 3 * rows); /* layer, friction without and with it */
    check("what_if", BALANCES, rows);
    assert_true(count[SHARES] > 0 && count[SHARES] <= 8);
    release(&r);
    r = run("<result>error_budget</result>", 3, false);
    const size_t passes = count[PASSES], contacts = count[WORKSPACES];
    assert_true(passes <= 9 * contacts); /* rules of one velocity */
    release(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_tables),   cmocka_unit_test(test_tables_with_replicates),
        cmocka_unit_test(test_figures),  cmocka_unit_test(test_digests),
        cmocka_unit_test(test_settings),
    };
    return cmocka_run_group_tests_name("left out", tests, NULL, NULL);
}
