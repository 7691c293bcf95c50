/* The counter surface: a self-affine law or a measured spectrum, with its stated error.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "friction/counter_surface.h"
#include "dma/law_parse.h"
#include "job/cost.h"
#include "job/inputs.h"
#include "job/random_draws.h"

#include "core/base/array.h"
#include "core/table/table_rows.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void wt_surface_clear(wt_surface *surface)
{
    if (surface == NULL)
        return;
    wt_power_spectrum_clear(&surface->spectrum);
    free(surface->modes_error);
    free(surface->modes_correlation);
    free(surface->law_error);
    free(surface->position_errors);
    *surface = (wt_surface){0};
}

/* ---- from text ------------------------------------------------------------------------------- */

wt_surface flow_surface_defaults(void)
{
    return (wt_surface){.q0 = (double)NAN,
                        .qr = (double)NAN,
                        .q1 = (double)NAN,
                        .hurst = (double)NAN,
                        .c0 = {(double)NAN, 0, 0, "m^4"}};
}

static const wt_param law_rows[] = {
    {PARAM("q0", wt_surface, q0, WT_Q_WAVENUMBER, ABOVE(0)),
     .flags = PARAM_REQUIRED | PARAM_NO_OPTION, .help = "smallest wavenumber"},
    {PARAM("qr", wt_surface, qr, WT_Q_WAVENUMBER, ABOVE(0)), .unset = "q0",
     .flags = PARAM_NO_OPTION, .help = "roll-off"},
    {PARAM("q1", wt_surface, q1, WT_Q_WAVENUMBER, ABOVE(0)),
     .flags = PARAM_REQUIRED | PARAM_NO_OPTION, .help = "largest wavenumber"},
    {PARAM("hurst", wt_surface, hurst, WT_Q_NONE, ABOVE_TO(-1, 3)),
     .flags = PARAM_REQUIRED | PARAM_NO_OPTION, .help = "Hurst exponent"},
    {PARAM("c0", wt_surface, c0, WT_Q_POWER_SPECTRUM_2D, ABOVE(0)),
     .flags = PARAM_REQUIRED | PARAM_NO_OPTION,
     .help = "two-dimensional power spectrum from q0 to qr, with h_rms^2 = 2 pi int q C dq"},
};
PARAM_TABLE(flow_self_affine_params, wt_surface, law_rows, flow_surface_defaults, NO_PARTS)

static const wt_param spectrum_rows[] = {
    {PARAM("q0", wt_surface, q0, WT_Q_WAVENUMBER, ABOVE(0)), .unset = "that of the file",
     .flags = PARAM_NO_OPTION, .help = "cut-off at small wavenumbers"},
    {PARAM("q1", wt_surface, q1, WT_Q_WAVENUMBER, ABOVE(0)), .unset = "that of the file",
     .flags = PARAM_NO_OPTION, .help = "cut-off at large wavenumbers"},
    {PARAM("error", wt_surface, c0.standard_error, WT_Q_NONE, AT_LEAST(0)),
     .flags = PARAM_NO_OPTION, .help = "relative error of the densities"},
};
PARAM_TABLE(flow_spectrum_params, wt_surface, spectrum_rows, flow_surface_defaults, NO_PARTS)

wt_status flow_surface_check(wt_surface *surface, wt_error *err)
{
    wt_roughness *law = NULL;
    if (isnan(surface->qr))
        surface->qr = surface->q0; /* no roll-off */
    wt_status status = wt_surface_roughness(surface, 1, &law, err);
    wt_roughness_free(law);
    return status;
}

static const flow_law_text self_affine = {
    .prefix = "self-affine:",
    .name = "self-affine law",
    .what = "roughness",
    .example = "q0=1e3rad/m,qr=5e3rad/m,q1=1e7rad/m,hurst=0.8,c0=1e-17m^4",
    .params = flow_self_affine_params,
};

static wt_status parse_self_affine(const char *text, wt_surface *surface, wt_error *err)
{
    *surface = flow_surface_defaults();
    surface->self_affine = true;
    return flow_law_parse(&self_affine, text, surface, err);
}

static double positive_key_value(const wt_table *table, size_t key)
{
    wt_estimate value = {0};
    return wt_table_estimate(table, power_spectrum_schema.keys[key].name, &value) &&
                   value.value > 0 && isfinite(value.value)
               ? value.value
               : 0;
}

/* Returns the errors of a column as an array [n] that the caller frees. Missing errors are 0, also
 * if the table has no such column. NULL if out of memory. */
static double *read_error_column(const wt_table *table, power_spectrum_column which, size_t n)
{
    const long column = wt_table_find(table, power_spectrum_schema.columns[which].name);
    const bool known =
        column >= 0 && wt_table_column_kind(table, (size_t)column) == WT_COLUMN_NUMBER;
    double *errors = wt_alloc(n + 1, sizeof *errors);
    for (size_t i = 0; i < n; i++) {
        const double error = known ? wt_table_number(table, i, (size_t)column) : 0;
        errors[i] = error > 0 && isfinite(error) ? error : 0;
    }
    return errors;
}

/* Reads an index from the table of position errors, where it counts from 1, and converts it to
 * count from 0. */
static bool read_index(const table_view *places, size_t row, place_errors_column column,
                       size_t most, size_t *to)
{
    const double value = place_errors_get(places, row, column);
    if (!(value >= 1) || !(value <= (double)most))
        return false;
    *to = (size_t)value - 1;
    return true;
}

/* Copies the errors that the positions of scans of several sizes give to the rows of the spectrum.
 * Scans of one size have no such table. */
static wt_status copy_position_errors(const wt_table *table, wt_surface *surface, wt_error *err)
{
    table_view view = {.n_rows = 0};
    wt_status status =
        table != NULL ? table_bind(table, &place_errors_schema, "", &view, err) : WT_OK;
    const size_t n = surface->spectrum.n, rows = view.n_rows;
    if (status != WT_OK || rows == 0)
        return status;
    for (size_t i = 0, size; status == WT_OK && i < rows; i++)
        if (read_index(&view, i, PLACE_ERRORS_SIZE, rows, &size) && size >= surface->n_sizes)
            surface->n_sizes = size + 1;
    surface->position_errors = wt_alloc(surface->n_sizes * n + 1, sizeof *surface->position_errors);
    for (size_t i = 0, size, at; status == WT_OK && i < rows; i++) {
        const double error = place_errors_get(&view, i, PLACE_ERRORS_ERROR);
        if (!read_index(&view, i, PLACE_ERRORS_SIZE, surface->n_sizes, &size) ||
            !read_index(&view, i, PLACE_ERRORS_ROW, n, &at) || !(error >= 0) || !isfinite(error)) {
            wt_fail(err, WT_E_RANGE, "row %zu of the table %s is of no row of the spectrum", i + 1,
                    place_errors_schema.name);
            wt_error_expected(err, "a size from 1, a row from 1 to %zu, an error of 0 or more", n);
            status = WT_E_RANGE;
        } else {
            surface->position_errors[size * n + at] = error / surface->c0.standard_error;
        }
    }
    return status;
}

/* Copies the errors and the limits of the table power_spectrum and, if the second table exists, the
 * errors of the positions. The flag is true if the rows of the table are the points that were read.
 */
static wt_status copy_table_errors(const wt_table *table, const wt_table *places,
                                   wt_surface *surface, bool *copied, wt_error *err)
{
    const wt_power_spectrum *s = &surface->spectrum;
    const long column =
        wt_table_find(table, power_spectrum_schema.columns[POWER_SPECTRUM_MODES_ERROR].name);
    wt_estimate place = {0};
    *copied = column >= 0 && wt_table_n_rows(table) == s->n &&
              wt_table_column_kind(table, (size_t)column) == WT_COLUMN_NUMBER;
    if (!*copied)
        return WT_OK;
    surface->modes_error = read_error_column(table, POWER_SPECTRUM_MODES_ERROR, s->n);
    surface->modes_correlation = read_error_column(table, POWER_SPECTRUM_MODES_TIE, s->n);
    surface->law_error = read_error_column(table, POWER_SPECTRUM_LAW_ERROR, s->n);
    if (wt_table_estimate(table, power_spectrum_schema.keys[POWER_SPECTRUM_KEY_PLACES_ERROR].name,
                          &place) &&
        place.value >= 0 && isfinite(place.value)) {
        surface->c0.standard_error = place.value;
        surface->has_position_scatter = true;
    }
    surface->measured_limit = positive_key_value(table, POWER_SPECTRUM_KEY_TO);
    surface->steep_wavenumber = positive_key_value(table, POWER_SPECTRUM_KEY_STEEP);
    return surface->c0.standard_error > 0 ? copy_position_errors(places, surface, err) : WT_OK;
}

/* Reads the errors from a file that this program wrote. A pipe can be read only once, so that its
 * errors are not available; the log then has a warning. */
static wt_status read_spectrum_errors(const flow_file *file, const wt_job *work,
                                      wt_surface *surface, wt_error *err)
{
    if (!wt_format_is_own(file->format))
        return WT_OK;
    wt_result *tables = NULL;
    bool copied = false;
    const bool piped = strcmp(file->path, "-") == 0;
    wt_status status =
        piped ? WT_OK
              : wt_tables_read(file->path, file->name, NULL,
                               (wt_tables_role){.role = WT_ROLE_ROUGHNESS}, &tables, err);
    const wt_table *table =
        status == WT_OK && !piped ? wt_result_find(tables, power_spectrum_schema.name) : NULL;
    if (table != NULL)
        status = copy_table_errors(table, wt_result_find(tables, place_errors_schema.name), surface,
                                   &copied, err);
    if (status == WT_OK && !copied && (piped || table != NULL))
        wt_log_add(work->log, WT_WARNING, file->name, NULL,
                   "the errors of the spectrum are not read%s: no error of a result contains "
                   "them",
                   piped ? " from a pipe; give a file" : "");
    wt_result_free(tables);
    return status;
}

/* Converts the spectrum of a profile to the spectrum C of the surface. */
static wt_status convert_profile_spectrum(const char *name, const wt_job *work,
                                          wt_power_spectrum *spectrum, wt_error *err)
{
    double *c = wt_alloc(spectrum->n + 1, sizeof *c);
    const wt_status status =
        wt_surface_from_profile(spectrum->wavenumber, spectrum->density, spectrum->n, c, err);
    if (status != WT_OK) {
        free(c);
        wt_error_file(err, name);
        return status;
    }
    free(spectrum->density);
    spectrum->density = c;
    spectrum->kind = WT_SPECTRUM_2D;
    wt_log_add(work->log, WT_WARNING, name, NULL,
               "the spectrum is that of a line (m^3): friction is for a surface that is the "
               "same in all directions");
    return WT_OK;
}

wt_status flow_surface_read(flow_file *file, const wt_job *work, wt_surface *surface, wt_error *err)
{
    wt_input *input = NULL;
    wt_status status = flow_open(work, file, WT_ROLE_ROUGHNESS, WT_KIND_SPECTRUM, &input, err);
    const wt_read_options read = flow_read_options(file);
    if (status == WT_OK)
        status =
            wt_power_spectrum_read(work->formats, input, &read, work->log, &surface->spectrum, err);
    wt_input_close(input);
    if (status == WT_OK && surface->spectrum.kind != WT_SPECTRUM_2D)
        status = convert_profile_spectrum(file->name, work, &surface->spectrum, err);
    surface->q0 = surface->q1 = (double)NAN;
    surface->c0 = (wt_estimate){1, 0, 0, "1"};
    return status == WT_OK ? read_spectrum_errors(file, work, surface, err) : status;
}

/* ---- from height maps ------------------------------------------------------------------------ */

static wt_status copy_spectrum(const wt_topography_tables *made, wt_surface *surface, wt_error *err)
{
    const wt_table *const table = made->power_spectrum;
    const size_t n = wt_table_n_rows(table);
    wt_power_spectrum *const s = &surface->spectrum;
    bool copied = false;
    s->kind = WT_SPECTRUM_2D;
    s->wavenumber = wt_alloc(n + 1, sizeof *s->wavenumber);
    s->density = wt_alloc(n + 1, sizeof *s->density);
    for (s->n = 0; s->n < n; s->n++) {
        s->wavenumber[s->n] = wt_table_number(table, s->n, POWER_SPECTRUM_WAVENUMBER);
        s->density[s->n] = wt_table_number(table, s->n, POWER_SPECTRUM_DENSITY);
    }
    return copy_table_errors(table, made->place_errors, surface, &copied, err);
}

wt_status flow_surface_measure(const wt_topography_job *job, const wt_job *work,
                               wt_surface *surface, wt_topography_tables *tables, wt_error *err)
{
    wt_topography_tables made = {.power_spectrum = NULL};
    wt_status status = wt_topography_compute(job, work, &made, err);
    surface->q0 = surface->q1 = (double)NAN;
    surface->c0 = (wt_estimate){1, 0, 0, "1"};
    if (status == WT_OK)
        status = copy_spectrum(&made, surface, err);
    if (status == WT_OK && tables != NULL) {
        *tables = made;
        return WT_OK;
    }
    wt_tables_clear(&made, sizeof made);
    return status;
}

/* True for several files, or for one file that can be a height map and cannot be a spectrum. */
static wt_status detect_height_maps(const flow_files *files, const wt_job *work, bool *heights,
                                    wt_error *err)
{
    wt_input *input = NULL;
    const wt_format_info *format = NULL;
    *heights = files->n > 1;
    if (files->n != 1 || strcmp(files->file[0].path, "-") == 0)
        return WT_OK;
    const wt_read_options *const read = &files->file[0].set->read;
    wt_status status = wt_input_open(files->file[0].path, &input, err);
    if (status == WT_OK && read->format == NULL)
        status = wt_format_detect(work->formats, input, read, WT_KIND_SPECTRUM | WT_KIND_IMAGE,
                                  &format, err);
    else if (status == WT_OK)
        format = wt_formats_find(work->formats, read->format);
    const unsigned kinds = status == WT_OK && format != NULL ? format->kinds : 0;
    *heights = (kinds & WT_KIND_IMAGE) != 0 && (kinds & WT_KIND_SPECTRUM) == 0;
    wt_input_close(input);
    return status;
}

/* Reads a spectrum, or the height maps of a file, a folder or a file pattern. */
static wt_status read_roughness_input(const char *path, const wt_read_options *read,
                                      const wt_job *work, wt_surface *surface, wt_error *err)
{
    const wt_file_set set = {
        .patterns = &path, .n_patterns = 1, .read = read != NULL ? *read : wt_read_defaults()};
    flow_files files = {0};
    wt_topography_job job = wt_topography_job_defaults();
    bool heights = false;
    job.sets = &set;
    job.n_sets = 1;
    if (work->formats == NULL)
        return wt_fail(err, WT_E_ARG, "no formats given to a job that reads files");
    wt_status status = flow_files_list(&set, 1, work, &files, err);
    if (status == WT_OK)
        status = detect_height_maps(&files, work, &heights, err);
    if (status == WT_OK && !heights)
        status = flow_surface_read(&files.file[0], work, surface, err);
    else if (status == WT_OK)
        status = flow_surface_measure(&job, work, surface, NULL, err);
    flow_files_clear(&files);
    return status;
}

void flow_surface_report_cost(const wt_surface *surface, const wt_job *work)
{
    const size_t items = surface->self_affine ? COUNT_OF(law_rows) : surface->spectrum.n;
    cost_report(work, (cost_summary){.items = (double)items});
}

wt_status wt_surface_open(const char *text, const wt_read_options *read, const wt_job *work,
                          wt_surface *surface, wt_error *err)
{
    if (text == NULL || surface == NULL || work == NULL)
        return wt_fail(err, WT_E_ARG, "no roughness");
    wt_surface s = {0};
    wt_status status = flow_has_law_prefix(&self_affine, text)
                           ? parse_self_affine(text, &s, err)
                           : read_roughness_input(text, read, work, &s, err);
    status = flow_law_suggest(&self_affine, text, status, err);
    if (status == WT_OK)
        status = flow_surface_check(&s, err);
    if (status != WT_OK) {
        wt_surface_clear(&s);
        return status;
    }
    *surface = s;
    flow_surface_report_cost(&s, work);
    return WT_OK;
}

/* ---- the law --------------------------------------------------------------------------------- */

/* Measured densities from q0 to q1. The densities at the limits are interpolated in log-log. */
static wt_status measured_spectrum_roughness(const wt_surface *surface, double factor,
                                             wt_roughness **roughness, wt_error *err)
{
    const wt_power_spectrum *s = &surface->spectrum;
    if (s->n < 2)
        return wt_fail(err, WT_E_EMPTY, "a spectrum needs two points or more");
    double q0 = isnan(surface->q0) ? s->wavenumber[0] : surface->q0;
    double q1 = isnan(surface->q1) ? s->wavenumber[s->n - 1] : surface->q1;
    if (!(q0 >= s->wavenumber[0]) || !(q1 <= s->wavenumber[s->n - 1]) || !(q0 < q1)) {
        wt_fail(err, WT_E_RANGE, "the cut-offs lie outside the spectrum");
        wt_error_expected(err, "%g <= q0 < q1 <= %g rad/m", s->wavenumber[0],
                          s->wavenumber[s->n - 1]);
        wt_error_found(err, "q0 = %g, q1 = %g rad/m", q0, q1);
        return WT_E_RANGE;
    }
    double *q = wt_alloc(2 * (s->n + 2), sizeof *q);
    double *c = q + s->n + 2;
    size_t n = 0;
    for (size_t i = 0; i < s->n; i++) {
        double limits[2] = {q0, q1};
        for (int e = 0; e < 2; e++) {
            if (i == 0 || !(limits[e] > s->wavenumber[i - 1]) || !(limits[e] < s->wavenumber[i]))
                continue;
            double t = log(limits[e] / s->wavenumber[i - 1]) /
                       log(s->wavenumber[i] / s->wavenumber[i - 1]);
            q[n] = limits[e];
            c[n++] = factor * exp((1 - t) * log(s->density[i - 1]) + t * log(s->density[i]));
        }
        if (s->wavenumber[i] < q0 || s->wavenumber[i] > q1)
            continue;
        q[n] = s->wavenumber[i];
        c[n++] = factor * s->density[i];
    }
    wt_status status = wt_roughness_table(q, c, n, roughness, err);
    free(q);
    return status;
}

wt_status wt_surface_roughness(const wt_surface *surface, double factor, wt_roughness **roughness,
                               wt_error *err)
{
    if (surface == NULL || roughness == NULL || !(factor > 0) || !isfinite(factor))
        return wt_fail(err, WT_E_ARG, "no surface, or a factor that is not positive");
    if (surface->self_affine)
        return wt_roughness_self_affine(surface->q0, surface->qr, surface->q1, surface->hurst,
                                        factor * surface->c0.value, roughness, err);
    return measured_spectrum_roughness(surface, factor, roughness, err);
}

/* Normal deviates of which only neighbours are correlated. They are computed from independent
 * deviates by the Cholesky factor of the correlation matrix. */
typedef struct deviate_chain {
    double correlation, own, before; /* correlation with the next deviate; factor of the own
                                independent deviate; last independent deviate */
} deviate_chain;

static double draw_chain_deviate(deviate_chain *c, double correlation, double independent)
{
    const double shared = c->own > 0 ? c->correlation / c->own : 0, own = sqrt(1 - shared * shared);
    const double z = shared * c->before + own * independent;
    *c = (deviate_chain){fmin(correlation, POWER_SPECTRUM_MAX_CORRELATION), own, independent};
    return z;
}

wt_status flow_surface_draw(const wt_surface *surface, double factor, uint64_t seed,
                            size_t replicate, wt_roughness **roughness, wt_error *err)
{
    const wt_power_spectrum *s = &surface->spectrum;
    if (replicate == WT_NO_REPLICATE || surface->modes_error == NULL || surface->self_affine)
        return wt_surface_roughness(surface, factor, roughness, err);
    wt_surface drawn = *surface;
    drawn.spectrum.density = wt_alloc(s->n + 1, sizeof *s->density);
    /* Each point has its own deviate, numbered after all other draws and correlated with that of
     * the next point. The fitted law takes the deviate of one more point. The positions of the
     * first scan size are drawn with the factor; each further size takes its own deviate. */
    const double law = flow_draw_normal(seed, replicate, (flow_draw)(FLOW_DRAW_MODES + s->n));
    const bool sizes = surface->position_errors != NULL;
    const double places = surface->c0.standard_error / surface->c0.value;
    deviate_chain scatter = {0};
    for (size_t i = 0; i < s->n; i++) {
        const double z = draw_chain_deviate(
            &scatter, surface->modes_correlation != NULL ? surface->modes_correlation[i] : 0,
            flow_draw_normal(seed, replicate, (flow_draw)(FLOW_DRAW_MODES + i)));
        const double by_law = surface->law_error != NULL ? surface->law_error[i] * law : 0;
        drawn.spectrum.density[i] = s->density[i] * exp(surface->modes_error[i] * z + by_law);
    }
    for (size_t size = 0; size < surface->n_sizes; size++) {
        const flow_draw what = (flow_draw)(FLOW_DRAW_MODES + s->n + size);
        const double by =
            size == 0 ? log(factor) : places * flow_draw_normal(seed, replicate, what);
        for (size_t i = 0; i < s->n; i++)
            drawn.spectrum.density[i] *= exp(by * surface->position_errors[size * s->n + i]);
    }
    const wt_status status = wt_surface_roughness(&drawn, sizes ? 1 : factor, roughness, err);
    free(drawn.spectrum.density);
    return status;
}

/* ---- the table ------------------------------------------------------------------------------- */

/* Resolution of a figure. */
#define ROUGHNESS_POINTS_PER_DECADE 20

TABLE_ROW(roughness, ROUGHNESS, double wavenumber, density;)

wt_status wt_surface_table(const wt_surface *surface, wt_table **table, wt_error *err)
{
    wt_roughness *roughness = NULL;
    wt_status status = wt_surface_roughness(surface, 1, &roughness, err);
    if (status != WT_OK)
        return status;
    table_writer t = table_begin(&roughness_schema, err);
    double decades = log10(roughness->q1 / roughness->q0);
    size_t n = 2 + (size_t)ceil(decades * ROUGHNESS_POINTS_PER_DECADE);
    for (size_t i = 0; i < n; i++) {
        double density = (double)NAN;
        double q = i + 1 == n ? roughness->q1
                              : roughness->q0 * pow(10, decades * (double)i / (double)(n - 1));
        roughness->law->density(roughness, &q, 1, &density);
        TABLE_ADD(roughness, &t, q, density);
    }
    /* The rms height is proportional to the square root of C, so that its relative error is half
     * that of C. */
    const wt_estimate c0 = flow_stated_estimate(surface->c0);
    double share = c0.standard_error / c0.value / 2;
    double height = wt_roughness_rms_height(roughness), slope = wt_roughness_rms_slope(roughness);
    roughness_set_value(&t, ROUGHNESS_KEY_RMS_HEIGHT, height, share * height, 0);
    roughness_set_value(&t, ROUGHNESS_KEY_RMS_SLOPE, slope, share * slope, 0);
    if (surface->self_affine) {
        roughness_set_print(&t, ROUGHNESS_KEY_HURST, "%g", surface->hurst);
        roughness_set(&t, ROUGHNESS_KEY_C0, c0);
        roughness_set_value(&t, ROUGHNESS_KEY_ROLL_OFF, surface->qr, 0, 0);
    }
    wt_roughness_free(roughness);
    return table_end(&t, table);
}
