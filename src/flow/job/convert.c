/* The convert job: an instrument file to tables in SI units.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "flow/job/inputs.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct conversion {
    const wt_convert_job *job;
    const wt_job *work;
    flow_file file;
    wt_input *input;
    wt_table_sink sink;
    void *user;
} conversion;

wt_convert_job wt_convert_job_defaults(void)
{
    return (wt_convert_job){.read = wt_read_defaults()};
}

enum { MAX_COLUMNS = 64 };

/* The channels of all segments, each quantity once: the columns of the table. */
static size_t curve_columns(const wt_force_curve *curve, const wt_channel **columns)
{
    size_t n = 0;
    for (size_t s = 0; s < curve->n_segments; s++)
        for (size_t c = 0; c < curve->segments[s].n_channels; c++) {
            const wt_channel *channel = &curve->segments[s].channels[c];
            size_t k = 0;
            while (k < n && columns[k]->quantity != channel->quantity)
                k++;
            if (k == n && n < MAX_COLUMNS)
                columns[n++] = channel;
        }
    return n;
}

static wt_status curve_table(const wt_force_curve *curve, wt_table **out, wt_error *err)
{
    char name[64], text[64];
    snprintf(name, sizeof name, "force_curve/%zu", curve->index);
    wt_table *t = wt_table_new(name, "force curve");
    const wt_channel *columns[MAX_COLUMNS];
    const size_t n = curve_columns(curve, columns);
    wt_status status = t != NULL ? WT_OK : wt_fail(err, WT_E_MEMORY, "out of memory");
    const struct {
        const char *key;
        double value;
        const char *unit;
    } keys[] = {{"position_x", curve->x, "m"},
                {"position_y", curve->y, "m"},
                {"spring_constant", curve->cantilever.spring_constant, "N/m"},
                {"sensitivity", curve->cantilever.sensitivity, "m/V"}};
    for (size_t i = 0; i < sizeof keys / sizeof keys[0] && status == WT_OK; i++)
        if (!isnan(keys[i].value))
            status = wt_table_set_estimate(t, keys[i].key,
                                           (wt_estimate){keys[i].value, 0, 0, keys[i].unit}, err);
    if (status == WT_OK) {
        snprintf(text, sizeof text, "%zu", curve->index);
        status = wt_table_set_key(t, "curve", text, err);
    }
    if (status == WT_OK)
        status = wt_table_add_text_column(t, "segment", "kind of segment", err);
    for (size_t k = 0; k < n && status == WT_OK; k++)
        status = wt_table_add_column(t, wt_quantity_id(columns[k]->quantity),
                                     wt_quantity_unit(columns[k]->quantity), columns[k]->name, err);
    for (size_t s = 0; s < curve->n_segments && status == WT_OK; s++) {
        const wt_segment *segment = &curve->segments[s];
        if (s > 0)
            status = wt_table_new_block(t, err);
        const wt_channel *of_segment[MAX_COLUMNS];
        for (size_t k = 0; k < n; k++)
            of_segment[k] = wt_segment_channel(segment, columns[k]->quantity);
        for (size_t i = 0; i < segment->n_points && status == WT_OK; i++) {
            status = wt_table_add_row(t, err);
            if (status == WT_OK)
                status = wt_table_put_text(t, 0, wt_segment_kind_name(segment->kind), err);
            for (size_t k = 0; k < n && status == WT_OK; k++)
                if (of_segment[k] != NULL)
                    wt_table_put(t, k + 1, of_segment[k]->values[i]);
        }
    }
    if (status != WT_OK) {
        wt_table_free(t);
        return status;
    }
    *out = t;
    return WT_OK;
}

/* A curve that cannot be read is recorded and the others go on. */
static wt_status convert_force(const conversion *c, wt_error *err)
{
    wt_force_source *source = NULL;
    wt_force_curve curve = {0};
    size_t n = 0, n_failed = 0;
    wt_status status =
        wt_force_open(c->work->formats, c->input, &c->file.read, c->work->log, &source, err);
    while (status == WT_OK) {
        wt_error failure = WT_ERROR_INIT;
        const wt_status got = wt_force_next(source, &curve, &failure);
        if (got == WT_END)
            break;
        if (got != WT_OK) {
            wt_error_file(&failure, wt_input_name(c->input));
            if (!flow_goes_on(c->work, got)) {
                if (err != NULL)
                    *err = failure;
                status = got;
                break;
            }
            n_failed++;
            status = flow_failed(c->work, wt_input_name(c->input), &failure, err);
            continue;
        }
        wt_table *table = NULL;
        status = curve_table(&curve, &table, err);
        if (status == WT_OK)
            status = c->sink(c->user, table, err);
        n++;
    }
    if (status == WT_OK && n == 0)
        status = wt_fail(err, n_failed > 0 ? WT_E_CORRUPT : WT_E_EMPTY, "no curve could be read");
    wt_force_curve_clear(&curve);
    wt_force_close(source);
    return status;
}

static wt_status convert_sweep(const conversion *c, wt_error *err)
{
    wt_sweep sweep = {0};
    wt_table *t = NULL;
    wt_status status =
        wt_sweep_read(c->work->formats, c->input, &c->file.read, c->work->log, &sweep, err);
    if (status != WT_OK)
        goto done;
    wt_sweep_sort(&sweep);
    const bool shear = sweep.deformation == WT_SHEAR;
    t = wt_table_new("sweep", "DMA frequency sweeps");
    if (t == NULL) {
        status = wt_fail(err, WT_E_MEMORY, "out of memory");
        goto done;
    }
    const wt_quantity storage = shear ? WT_Q_SHEAR_STORAGE_MODULUS : WT_Q_STORAGE_MODULUS;
    const wt_quantity loss = shear ? WT_Q_SHEAR_LOSS_MODULUS : WT_Q_LOSS_MODULUS;
    const wt_quantity quantities[] = {WT_Q_TEMPERATURE, WT_Q_ANGULAR_FREQUENCY, storage, loss};
    for (size_t i = 0; i < 4 && status == WT_OK; i++)
        status =
            wt_table_add_column(t, wt_quantity_id(quantities[i]), wt_quantity_unit(quantities[i]),
                                wt_quantity_title(quantities[i]), err);
    for (size_t k = 0; k < sweep.n_isotherms && status == WT_OK; k++) {
        const wt_isotherm *iso = &sweep.isotherms[k];
        if (k > 0)
            status = wt_table_new_block(t, err);
        for (size_t i = 0; i < iso->n && status == WT_OK; i++) {
            status = wt_table_add_row(t, err);
            if (status != WT_OK)
                break;
            wt_table_put(t, 0, iso->temperature);
            wt_table_put(t, 1, iso->angular_frequency[i]);
            wt_table_put(t, 2, iso->storage_modulus[i]);
            wt_table_put(t, 3, iso->loss_modulus[i]);
        }
    }
    if (status == WT_OK) {
        status = c->sink(c->user, t, err);
        t = NULL;
    }
done:
    wt_table_free(t);
    wt_sweep_clear(&sweep);
    return status;
}

static wt_status image_table(const wt_image *image, size_t number, wt_table **out, wt_error *err)
{
    char name[64];
    snprintf(name, sizeof name, "image/%zu", number);
    wt_table *t = wt_table_new(name, image->name);
    wt_status status = t != NULL ? WT_OK : wt_fail(err, WT_E_MEMORY, "out of memory");
    const bool flat = image->n_rows < 2;
    if (status == WT_OK)
        status = wt_table_add_column(t, "x", image->x_unit, "first axis", err);
    if (status == WT_OK && !flat)
        status = wt_table_add_column(t, "y", "m", "second axis", err);
    if (status == WT_OK)
        status = wt_table_add_column(t, "value", image->unit, image->name, err);
    const double steps_x = image->n_columns > 1 ? (double)(image->n_columns - 1) : 1;
    const double steps_y = image->n_rows > 1 ? (double)(image->n_rows - 1) : 1;
    for (size_t row = 0; row < image->n_rows && status == WT_OK; row++) {
        if (row > 0)
            status = wt_table_new_block(t, err);
        for (size_t column = 0; column < image->n_columns && status == WT_OK; column++) {
            status = wt_table_add_row(t, err);
            if (status != WT_OK)
                break;
            size_t k = 0;
            wt_table_put(t, k++, image->x_min + image->width * (double)column / steps_x);
            if (!flat)
                wt_table_put(t, k++, image->y_min + image->height * (double)row / steps_y);
            wt_table_put(t, k, image->values[row * image->n_columns + column]);
        }
    }
    if (status != WT_OK) {
        wt_table_free(t);
        return status;
    }
    *out = t;
    return WT_OK;
}

static wt_status convert_images(const conversion *c, wt_error *err)
{
    wt_image *images = NULL;
    size_t n = 0;
    wt_status status =
        wt_images_read(c->work->formats, c->input, &c->file.read, c->work->log, &images, &n, err);
    for (size_t i = 0; i < n && status == WT_OK; i++) {
        wt_table *t = NULL;
        status = image_table(&images[i], i, &t, err);
        if (status == WT_OK)
            status = c->sink(c->user, t, err);
    }
    for (size_t i = 0; i < n; i++)
        wt_image_clear(&images[i]);
    free(images);
    return status;
}

static wt_status convert_spectrum(const conversion *c, wt_error *err)
{
    wt_power_spectrum spectrum = {0};
    wt_table *t = NULL;
    wt_status status = wt_power_spectrum_read(c->work->formats, c->input, &c->file.read,
                                              c->work->log, &spectrum, err);
    if (status != WT_OK)
        return status;
    const wt_quantity density =
        spectrum.kind == WT_SPECTRUM_2D ? WT_Q_POWER_SPECTRUM_2D : WT_Q_POWER_SPECTRUM_1D;
    t = wt_table_new("roughness", "power spectrum");
    if (t == NULL)
        status = wt_fail(err, WT_E_MEMORY, "out of memory");
    if (status == WT_OK)
        status = wt_table_add_column(t, "wavenumber", wt_quantity_unit(WT_Q_WAVENUMBER),
                                     "wavenumber", err);
    if (status == WT_OK)
        status = wt_table_add_column(t, wt_quantity_id(density), wt_quantity_unit(density),
                                     wt_quantity_title(density), err);
    for (size_t i = 0; i < spectrum.n && status == WT_OK; i++) {
        status = wt_table_add_row(t, err);
        if (status != WT_OK)
            break;
        wt_table_put(t, 0, spectrum.wavenumber[i]);
        wt_table_put(t, 1, spectrum.density[i]);
    }
    wt_power_spectrum_clear(&spectrum);
    if (status == WT_OK)
        return c->sink(c->user, t, err);
    wt_table_free(t);
    return status;
}

/* In the order in which a file that holds several kinds is asked. */
static const struct {
    const char *word;
    unsigned kind;
    wt_status (*convert)(const conversion *c, wt_error *err);
} kinds[] = {{"force", WT_KIND_FORCE, convert_force},
             {"sweep", WT_KIND_SWEEP, convert_sweep},
             {"spectrum", WT_KIND_SPECTRUM, convert_spectrum},
             {"image", WT_KIND_IMAGE, convert_images}};
#define KIND_WORDS "force|sweep|spectrum|image"

static wt_status read_kind(const char *text, void *member, wt_error *err)
{
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++)
        if (strcmp(kinds[i].word, text) == 0) {
            *(unsigned *)member = kinds[i].kind;
            return WT_OK;
        }
    return wt_fail(err, WT_E_ARG, "'%s' is none of %s", text, KIND_WORDS);
}

static const wt_param rows[] = {
    {PARAM_OTHER_OF("kind", wt_convert_job, kind, read_kind), .value = KIND_WORDS,
     .unset = "the first of these that the file has", .flags = PARAM_NO_CASE,
     .help = "which data of a file that holds several kinds"},
};
PARAM_TABLE(wt_convert_job_params, wt_convert_job, rows, wt_convert_job_defaults,
            PARAM_PART(wt_read_params, wt_convert_job, read))

wt_status wt_convert_file(const wt_convert_job *job, const char *path, const wt_job *work,
                          wt_table_sink sink, void *user, wt_error *err)
{
    const wt_file_set set = {.read = job->read};
    conversion c = {.job = job,
                    .work = work,
                    .file = {.path = path, .name = path, .set = &set},
                    .sink = sink,
                    .user = user};
    wt_error failure = WT_ERROR_INIT;
    wt_status status = flow_open(work, &c.file, "input", job->kind, &c.input, err);
    if (status != WT_OK)
        return status;
    /* An .nid file may hold images and curves: the first kind that has data counts. */
    status = WT_E_EMPTY;
    for (size_t k = 0; k < sizeof kinds / sizeof kinds[0] && status == WT_E_EMPTY; k++) {
        if ((c.file.format->kinds & kinds[k].kind) == 0 ||
            (job->kind != 0 && job->kind != kinds[k].kind))
            continue;
        failure = (wt_error)WT_ERROR_INIT;
        status = kinds[k].convert(&c, &failure);
    }
    if (status == WT_E_EMPTY && failure.status == WT_OK) {
        wt_fail(&failure, WT_E_EMPTY, "the file holds no data of that kind");
        wt_error_found(&failure, "%s", c.file.format->title);
    }
    if (status != WT_OK) {
        wt_error_file(&failure, path);
        if (err != NULL)
            *err = failure;
    }
    wt_input_close(c.input);
    return status;
}
