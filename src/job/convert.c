/* Converts an instrument file to tables in SI units. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/array.h"
#include "core/data/force_curve.h"
#include "core/table/registry.h"
#include "job/conditioning.h"
#include "job/inputs.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct conversion {
    const wt_job *work;
    flow_file file;
    wt_input *input;
    wt_read_options read;
    wt_table_sink sink;
    void *user;
} conversion;

wt_convert_job wt_convert_job_defaults(void)
{
    return (wt_convert_job){.read = wt_read_defaults()};
}

/* Lists the channels of all segments, one for each quantity. They are additional columns of the
 * table. */
static size_t curve_columns(const wt_force_curve *curve, const wt_channel *columns[WT_Q_COUNT])
{
    size_t n = 0;
    for (size_t s = 0; s < curve->n_segments; s++)
        for (size_t c = 0; c < curve->segments[s].n_channels; c++) {
            const wt_channel *channel = &curve->segments[s].channels[c];
            size_t k = 0;
            while (k < n && columns[k]->quantity != channel->quantity)
                k++;
            if (k == n)
                columns[n++] = channel;
        }
    return n;
}

static wt_status send_table(const conversion *c, table_writer *t, wt_error *err)
{
    wt_table *table = NULL;
    const wt_status status = table_end(t, &table);
    return status == WT_OK ? c->sink(c->user, table, err) : status;
}

static wt_status send_curve(const conversion *c, const wt_force_curve *curve, wt_error *err)
{
    const wt_channel *columns[WT_Q_COUNT], *of_segment[WT_Q_COUNT];
    const size_t n = curve_columns(curve, columns);
    char number[32];
    snprintf(number, sizeof number, "%zu", curve->index);
    table_writer t =
        table_begin_variant(&force_curve_schema, (table_variant){.suffix = number}, err);
    const struct {
        force_curve_key key;
        double value;
    } keys[] = {{FORCE_CURVE_KEY_POSITION_X, curve->x},
                {FORCE_CURVE_KEY_POSITION_Y, curve->y},
                {FORCE_CURVE_KEY_SPRING_CONSTANT, curve->cantilever.spring_constant},
                {FORCE_CURVE_KEY_SENSITIVITY, curve->cantilever.sensitivity}};
    for (size_t i = 0; i < COUNT_OF(keys); i++)
        if (!isnan(keys[i].value))
            force_curve_set_value(&t, keys[i].key, keys[i].value, 0, 0);
    force_curve_set_text(&t, FORCE_CURVE_KEY_CURVE, number);
    for (size_t k = 0; k < n && t.status == WT_OK; k++)
        t.status =
            wt_table_add_column(t.table, wt_quantity_id(columns[k]->quantity),
                                wt_quantity_unit(columns[k]->quantity), columns[k]->name, err);
    for (size_t s = 0; s < curve->n_segments; s++) {
        const wt_segment *segment = &curve->segments[s];
        table_block(&t);
        for (size_t k = 0; k < n; k++)
            of_segment[k] = wt_segment_channel(segment, columns[k]->quantity);
        for (size_t i = 0; i < segment->n_points; i++) {
            table_row(&t);
            force_curve_put_text(&t, FORCE_CURVE_SEGMENT, wt_segment_kind_name(segment->kind));
            for (size_t k = 0; k < n && t.status == WT_OK; k++)
                if (of_segment[k] != NULL)
                    wt_table_set_number(t.table, FORCE_CURVE_N_COLUMNS + k,
                                        of_segment[k]->values[i]);
        }
    }
    return send_table(c, &t, err);
}

/* A curve that cannot be read is recorded as a failure, and the conversion continues. */
static wt_status convert_force(const conversion *c, wt_error *err)
{
    wt_force_source *source = NULL;
    wt_force_curve curve = {0};
    size_t n = 0, n_failed = 0;
    wt_status status =
        wt_force_open(c->work->formats, c->input, &c->read, c->work->log, &source, err);
    while (status == WT_OK) {
        wt_error failure = WT_ERROR_INIT;
        const wt_status got = wt_force_next(source, &curve, &failure);
        if (got == WT_END)
            break;
        if (got != WT_OK) {
            n_failed++;
            status = wt_job_add_failure(c->work, wt_input_name(c->input), got, &failure, err);
            continue;
        }
        status = send_curve(c, &curve, err);
        n++;
    }
    if (status == WT_OK && n == 0)
        status = wt_fail(err, n_failed > 0 ? WT_E_CORRUPT : WT_E_EMPTY, "no curve could be read");
    wt_force_curve_clear(&curve);
    wt_force_close(source);
    return status;
}

/* Point of any sweep; values without a measurement are NaN. */
typedef struct dma_point {
    double temperature, angular_frequency, storage, loss, strain, factor;
    const char *sample;
} dma_point;

static double value_or_nan(const double *values, size_t i)
{
    return values != NULL ? values[i] : (double)NAN;
}

typedef struct dma_table {
    table_writer writer;
    sweep_column storage, loss;
    wt_loading loading;
    uint64_t used; /* bits of the columns with at least one value */
    bool counting; /* first pass: nothing is written */
} dma_table;

static void write_measured(dma_table *t, sweep_column column, double value)
{
    if (isnan(value))
        return;
    t->used |= SCHEMA_BIT(column);
    if (!t->counting)
        sweep_put(&t->writer, column, value);
}

static void write_dma_point(dma_table *t, const dma_point *p)
{
    if (!t->counting) {
        table_row(&t->writer);
        sweep_put(&t->writer, SWEEP_TEMPERATURE, p->temperature);
    }
    if (t->loading == WT_OSCILLATION)
        write_measured(t, SWEEP_ANGULAR_FREQUENCY, p->angular_frequency);
    else
        write_measured(t, SWEEP_TIME, 1 / p->angular_frequency);
    write_measured(t, t->storage, t->loading == WT_CREEP ? 1 / p->storage : p->storage);
    write_measured(t, t->loss, p->loss);
    write_measured(t, SWEEP_STRAIN, p->strain);
    write_measured(t, SWEEP_LOSS_FACTOR, p->factor);
    if (p->sample == NULL)
        return;
    t->used |= SCHEMA_BIT(SWEEP_SAMPLE);
    if (!t->counting)
        sweep_put_text(&t->writer, SWEEP_SAMPLE, p->sample);
}

static void write_sweep_points(dma_table *t, const wt_sweep *sweep)
{
    for (size_t k = 0; k < sweep->n_isotherms; k++) {
        const wt_isotherm *s = &sweep->isotherms[k];
        if (!t->counting)
            table_block(&t->writer);
        for (size_t row = 0; row < s->n; row++) {
            const size_t i = t->loading == WT_OSCILLATION ? row : s->n - 1 - row; /* rising time */
            write_dma_point(t, &(dma_point){s->temperature, s->angular_frequency[i],
                                            s->storage_modulus[i], s->loss_modulus[i],
                                            value_or_nan(s->strain, i),
                                            value_or_nan(s->loss_factor, i), s->sample});
        }
    }
    for (size_t k = 0; k < sweep->n_ramps; k++) {
        const wt_ramp *s = &sweep->ramps[k];
        if (!t->counting)
            table_block(&t->writer);
        for (size_t i = 0; i < s->n; i++)
            write_dma_point(t, &(dma_point){s->temperature[i], s->angular_frequency,
                                            s->storage_modulus[i], s->loss_modulus[i],
                                            value_or_nan(s->strain, i),
                                            value_or_nan(s->loss_factor, i), s->sample});
    }
    for (size_t k = 0; k < sweep->n_strain_sweeps; k++) {
        const wt_strain_sweep *s = &sweep->strain_sweeps[k];
        if (!t->counting)
            table_block(&t->writer);
        for (size_t i = 0; i < s->n; i++)
            write_dma_point(t, &(dma_point){s->temperature, s->angular_frequency,
                                            s->storage_modulus[i], s->loss_modulus[i], s->strain[i],
                                            (double)NAN, s->sample});
    }
}

/* Sends a table without empty columns. */
static wt_status send_sweep(const conversion *c, const wt_sweep *sweep, wt_error *err)
{
    static const sweep_column optional_columns[] = {SWEEP_ANGULAR_FREQUENCY,
                                                    SWEEP_TIME,
                                                    SWEEP_RELAXATION_MODULUS,
                                                    SWEEP_SHEAR_RELAXATION_MODULUS,
                                                    SWEEP_CREEP_COMPLIANCE,
                                                    SWEEP_SHEAR_CREEP_COMPLIANCE,
                                                    SWEEP_STORAGE_MODULUS,
                                                    SWEEP_LOSS_MODULUS,
                                                    SWEEP_SHEAR_STORAGE_MODULUS,
                                                    SWEEP_SHEAR_LOSS_MODULUS,
                                                    SWEEP_STRAIN,
                                                    SWEEP_LOSS_FACTOR,
                                                    SWEEP_SAMPLE};
    /* by type of loading, in tension and in shear */
    static const sweep_column moduli[][2] = {
        [WT_OSCILLATION] = {SWEEP_STORAGE_MODULUS, SWEEP_SHEAR_STORAGE_MODULUS},
        [WT_RELAXATION] = {SWEEP_RELAXATION_MODULUS, SWEEP_SHEAR_RELAXATION_MODULUS},
        [WT_CREEP] = {SWEEP_CREEP_COMPLIANCE, SWEEP_SHEAR_CREEP_COMPLIANCE}};
    const bool shear = sweep->deformation == WT_SHEAR;
    dma_table t = {.storage = moduli[sweep->loading][shear],
                   .loading = sweep->loading,
                   .loss = shear ? SWEEP_SHEAR_LOSS_MODULUS : SWEEP_LOSS_MODULUS,
                   .counting = true};
    uint64_t left_out = 0;
    write_sweep_points(&t, sweep);
    for (size_t i = 0; i < COUNT_OF(optional_columns); i++)
        left_out |= SCHEMA_BIT(optional_columns[i]) & ~t.used;
    t.writer = table_begin_variant(&sweep_schema, (table_variant){.left_out = left_out}, err);
    t.counting = false;
    write_sweep_points(&t, sweep);
    return send_table(c, &t.writer, err);
}

static wt_status convert_sweep(const conversion *c, wt_error *err)
{
    wt_sweep sweep = {0};
    wt_status status =
        wt_sweep_read(c->work->formats, c->input, &c->read, c->work->log, &sweep, err);
    if (status == WT_OK) {
        wt_sweep_sort(&sweep);
        check_sweep(&sweep, c->work->log);
        status = send_sweep(c, &sweep, err);
    }
    wt_sweep_clear(&sweep);
    return status;
}

static wt_status send_image(const conversion *c, const wt_image *image, size_t number,
                            wt_error *err)
{
    const bool flat = image->n_rows < 2;
    const double steps_x = image->n_columns > 1 ? (double)(image->n_columns - 1) : 1;
    const double steps_y = image->n_rows > 1 ? (double)(image->n_rows - 1) : 1;
    schema_field columns[IMAGE_N_COLUMNS];
    char suffix[32];
    snprintf(suffix, sizeof suffix, "%zu", number);
    memcpy(columns, image_schema.columns, sizeof columns);
    columns[IMAGE_X].unit = image->x_unit;
    columns[IMAGE_VALUE].unit = image->unit;
    columns[IMAGE_VALUE].long_name = image->name;
    const table_variant variant = {.suffix = suffix,
                                   .title = image->name,
                                   .left_out = flat ? SCHEMA_BIT(IMAGE_Y) : 0,
                                   .columns = columns};
    table_writer t = table_begin_variant(&image_schema, variant, err);
    for (size_t row = 0; row < image->n_rows; row++) {
        table_block(&t);
        for (size_t column = 0; column < image->n_columns; column++) {
            table_row(&t);
            image_put(&t, IMAGE_X, image->x_min + image->width * (double)column / steps_x);
            if (!flat)
                image_put(&t, IMAGE_Y, image->y_min + image->height * (double)row / steps_y);
            image_put(&t, IMAGE_VALUE, image->values[row * image->n_columns + column]);
        }
    }
    return send_table(c, &t, err);
}

static wt_status convert_images(const conversion *c, wt_error *err)
{
    wt_image *images = NULL;
    size_t n = 0;
    wt_status status =
        wt_images_read(c->work->formats, c->input, &c->read, c->work->log, &images, &n, err);
    for (size_t i = 0; i < n && status == WT_OK; i++)
        status = send_image(c, &images[i], i, err);
    for (size_t i = 0; i < n; i++)
        wt_image_clear(&images[i]);
    free(images);
    return status;
}

static wt_status convert_spectrum(const conversion *c, wt_error *err)
{
    wt_power_spectrum s = {0};
    wt_status status =
        wt_power_spectrum_read(c->work->formats, c->input, &c->read, c->work->log, &s, err);
    const bool surface = s.kind == WT_SPECTRUM_2D;
    const spectrum_column density = surface ? SPECTRUM_DENSITY_2D : SPECTRUM_DENSITY_1D,
                          other = surface ? SPECTRUM_DENSITY_1D : SPECTRUM_DENSITY_2D;
    if (status == WT_OK) {
        table_writer t = table_begin_variant(&spectrum_schema,
                                             (table_variant){.left_out = SCHEMA_BIT(other)}, err);
        for (size_t i = 0; i < s.n; i++) {
            table_row(&t);
            spectrum_put(&t, SPECTRUM_WAVENUMBER, s.wavenumber[i]);
            spectrum_put(&t, density, s.density[i]);
        }
        status = send_table(c, &t, err);
    }
    wt_power_spectrum_clear(&s);
    return status;
}

/* Kinds of data, in the order in which a file with several kinds is tried. */
static const struct {
    const char *word;
    unsigned kind;
    wt_status (*convert)(const conversion *c, wt_error *err);
} kinds[] = {{"force", WT_KIND_FORCE, convert_force},
             {"sweep", WT_KIND_SWEEP, convert_sweep},
             {"spectrum", WT_KIND_SPECTRUM, convert_spectrum},
             {"image", WT_KIND_IMAGE, convert_images}};
#define KIND_NAMES "force|sweep|spectrum|image"

static wt_status parse_kind(const char *text, void *member, wt_error *err)
{
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++)
        if (strcmp(kinds[i].word, text) == 0) {
            *(unsigned *)member = kinds[i].kind;
            return WT_OK;
        }
    return wt_fail(err, WT_E_ARG, "'%s' is not one of %s", text, KIND_NAMES);
}

static const wt_param rows[] = {
    {PARAM_OTHER_OF("kind", wt_convert_job, kind, parse_kind), .value = KIND_NAMES,
     .unset = "the first of these that the file has", .flags = PARAM_NO_CASE,
     .help = "which data of a file that holds several kinds"},
};
PARAM_TABLE(wt_convert_job_params, wt_convert_job, rows, wt_convert_job_defaults,
            PARAM_PART(wt_read_params, wt_convert_job, read))

wt_status wt_convert_file(const wt_convert_job *job, const char *path, const wt_job *work,
                          wt_table_sink sink, void *user, wt_error *err)
{
    const wt_file_set set = {.read = job->read};
    conversion c = {.work = work,
                    .file = {.path = path, .name = path, .set = &set},
                    .sink = sink,
                    .user = user};
    wt_error failure = WT_ERROR_INIT;
    wt_status status = flow_open(work, &c.file, WT_ROLE_INPUT, job->kind, &c.input, err);
    if (status != WT_OK)
        return status;
    c.read = flow_read_options(&c.file);
    /* An .nid file may contain images and curves; the first kind with data is used. */
    status = WT_E_EMPTY;
    for (size_t k = 0; k < COUNT_OF(kinds) && status == WT_E_EMPTY; k++) {
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
