/* Reads every line of expected.txt against the fixtures. A description without a line is an
 * error, so that every format has a fixture.
 *
 * check_formats FIXTURES EXPECTED
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "../status_name.h"
#include "weartrack/read.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define ITEMS_MAX 64

typedef struct reading {
    size_t line;
    const char *file, *kind;
    char *keys[ITEMS_MAX], *values[ITEMS_MAX];
    size_t n;
    wt_read_options options;
    const char *units[8];
    int failures;
} reading;

static void fail(reading *r, const char *format, ...) __attribute__((format(printf, 2, 3)));
static void fail(reading *r, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    fprintf(stderr, "expected.txt:%zu: %s: ", r->line, r->file);
    vfprintf(stderr, format, arguments);
    fputc('\n', stderr);
    va_end(arguments);
    r->failures++;
}

static double number(const char *text)
{
    return strtod(text, NULL);
}

static const char *item(const reading *r, const char *key)
{
    for (size_t i = 0; i < r->n; i++)
        if (strcmp(r->keys[i], key) == 0)
            return r->values[i];
    return NULL;
}

static void is(reading *r, const char *what, double found, const char *expected)
{
    const double e = number(expected);
    if (!(fabs(found - e) <= 1e-9 * fabs(e) + 1e-30) && !(isnan(found) && isnan(e)))
        fail(r, "%s is %.12g, expected %s", what, found, expected);
}

static void is_word(reading *r, const char *what, const char *found, const char *expected)
{
    if (strcmp(found, expected) != 0)
        fail(r, "%s is %s, expected %s", what, found, expected);
}

static void take_options(reading *r)
{
    r->options = wt_read_defaults();
    /* Every quantity is requested by its name, so that a missing one is an error. */
    r->options.want = WT_Q_ALL & ~WT_Q_BIT(WT_Q_NONE);
    r->options.units = r->units;
    for (size_t i = 0; i < r->n; i++) {
        if (strcmp(r->keys[i], "units") == 0)
            r->units[r->options.n_units++] = r->values[i];
        else if (strcmp(r->keys[i], "temperature") == 0)
            r->options.temperature = number(r->values[i]) + 273.15;
        else if (strcmp(r->keys[i], "spring_constant") == 0)
            r->options.spring_constant = number(r->values[i]);
        else if (strcmp(r->keys[i], "sensitivity") == 0)
            r->options.sensitivity = number(r->values[i]);
        else if (strcmp(r->keys[i], "pixel_size") == 0)
            r->options.pixel_size = number(r->values[i]);
        else if (strcmp(r->keys[i], "said") == 0)
            r->options.deformation = strcmp(r->values[i], "shear") == 0 ? WT_DEFORMATION_SHEAR
                                     : strcmp(r->values[i], "bending") == 0
                                         ? WT_DEFORMATION_BENDING
                                         : WT_DEFORMATION_TENSION;
    }
}

static void with_blanks(const char *from, char *to, size_t size)
{
    snprintf(to, size, "%s", from);
    for (char *c = to; *c != '\0'; c++)
        *c = *c == '_' ? ' ' : *c;
}

/* Returns true if the reading is to be checked further. */
static bool has_status(reading *r, wt_status status, const wt_error *err)
{
    const char *expected = item(r, "status");
    const char *advice = item(r, "advice");
    char text[1024], wanted[128];
    wt_error_format(err, text, sizeof text);
    is_word(r, status == WT_OK ? "status" : text, status_name(status),
            expected != NULL ? expected : "WT_OK");
    const char *found = item(r, "found");
    if (found != NULL) {
        with_blanks(found, wanted, sizeof wanted);
        if (strstr(err->found, wanted) == NULL)
            fail(r, "found is \"%s\", expected \"%s\" in it", err->found, wanted);
    }
    if (advice != NULL) {
        with_blanks(advice, wanted, sizeof wanted);
        if (strstr(err->advice, wanted) == NULL)
            fail(r, "advice is \"%s\", expected \"%s\" in it", err->advice, wanted);
    }
    return status == WT_OK;
}

/* The first warning contains the expected text, or there is no warning. */
static void check_warning(reading *r, const wt_log *log)
{
    const char *expected = item(r, "warning"), *found = NULL;
    char wanted[128] = "";
    if (expected != NULL)
        with_blanks(expected, wanted, sizeof wanted);
    for (size_t i = 0; i < wt_log_count(log) && found == NULL; i++)
        if (wt_log_get(log, i).severity == WT_WARNING)
            found = wt_log_get(log, i).text;
    if (expected == NULL ? found != NULL : found == NULL || strstr(found, wanted) == NULL)
        fail(r, "warning is \"%s\", expected \"%s\" in it", found != NULL ? found : "", wanted);
}

static void check_strain_sweep(reading *r, const char *key, const char *value,
                               const wt_strain_sweep *s)
{
    const size_t last = s->n - 1;
    if (strcmp(key, "points") == 0)
        is(r, key, (double)s->n, value);
    else if (strcmp(key, "w") == 0)
        is(r, key, s->angular_frequency, value);
    else if (strcmp(key, "temperature_is") == 0)
        is(r, key, round((s->temperature - 273.15) * 1e9) / 1e9, value);
    else if (strcmp(key, "strain") == 0)
        is(r, key, s->strain[0], value);
    else if (strcmp(key, "strain_last") == 0)
        is(r, key, s->strain[last], value);
    else if (strcmp(key, "storage") == 0)
        is(r, key, s->storage_modulus[0], value);
    else if (strcmp(key, "loss") == 0)
        is(r, key, s->loss_modulus[0], value);
    else if (strcmp(key, "storage_last") == 0)
        is(r, key, s->storage_modulus[last], value);
}

static void check_ramp(reading *r, const char *key, const char *value, const wt_ramp *ramp)
{
    const size_t last = ramp->n - 1;
    if (strcmp(key, "points") == 0)
        is(r, key, (double)ramp->n, value);
    else if (strcmp(key, "w") == 0)
        is(r, key, ramp->angular_frequency, value);
    else if (strcmp(key, "coldest") == 0)
        is(r, key, round((ramp->temperature[0] - 273.15) * 1e9) / 1e9, value);
    else if (strcmp(key, "warmest") == 0)
        is(r, key, round((ramp->temperature[last] - 273.15) * 1e9) / 1e9, value);
    else if (strcmp(key, "storage") == 0)
        is(r, key, ramp->storage_modulus[0], value);
    else if (strcmp(key, "loss") == 0)
        is(r, key, ramp->loss_modulus[0], value);
    else if (strcmp(key, "storage_last") == 0)
        is(r, key, ramp->storage_modulus[last], value);
}

static void check_sweep(reading *r, const wt_formats *formats, wt_input *input)
{
    wt_sweep sweep = {.n_isotherms = 0};
    wt_error err = WT_ERROR_INIT;
    const wt_isotherm *s = NULL;
    const wt_ramp *ramp = NULL;
    const wt_strain_sweep *strain = NULL;
    wt_log *log = wt_log_new();
    wt_status status = wt_sweep_read(formats, input, &r->options, log, &sweep, &err);
    if (status == WT_OK)
        check_warning(r, log);
    wt_log_free(log);
    if (!has_status(r, status, &err))
        return;
    for (size_t i = 0; i < r->n; i++) {
        const char *key = r->keys[i], *value = r->values[i];
        if (strcmp(key, "isotherms") == 0)
            is(r, key, (double)sweep.n_isotherms, value);
        else if (strcmp(key, "deformation") == 0)
            is_word(r, key, sweep.deformation == WT_TENSION ? "tension" : "shear", value);
        else if (strcmp(key, "at") == 0)
            s = number(value) < (double)sweep.n_isotherms ? &sweep.isotherms[atoi(value)] : NULL;
        else if (strcmp(key, "ramps") == 0)
            is(r, key, (double)sweep.n_ramps, value);
        else if (strcmp(key, "ramp") == 0)
            ramp = number(value) < (double)sweep.n_ramps ? &sweep.ramps[atoi(value)] : NULL;
        else if (strcmp(key, "strain_sweeps") == 0)
            is(r, key, (double)sweep.n_strain_sweeps, value);
        else if (strcmp(key, "strain_sweep") == 0)
            strain = number(value) < (double)sweep.n_strain_sweeps
                         ? &sweep.strain_sweeps[atoi(value)]
                         : NULL;
        if (ramp != NULL)
            check_ramp(r, key, value, ramp);
        if (strain != NULL)
            check_strain_sweep(r, key, value, strain);
        if (s == NULL)
            continue;
        if (strcmp(key, "temperature_is") == 0)
            is(r, key, round((s->temperature - 273.15) * 1e9) / 1e9, value);
        else if (strcmp(key, "points") == 0)
            is(r, key, (double)s->n, value);
        else if (strcmp(key, "w") == 0)
            is(r, key, s->angular_frequency[0], value);
        else if (strcmp(key, "w_last") == 0)
            is(r, key, s->angular_frequency[s->n - 1], value);
        else if (strcmp(key, "storage") == 0)
            is(r, key, s->storage_modulus[0], value);
        else if (strcmp(key, "loss") == 0)
            is(r, key, s->loss_modulus[0], value);
        else if (strcmp(key, "strain") == 0)
            is(r, key, s->strain != NULL ? s->strain[0] : (double)NAN, value);
        else if (strcmp(key, "factor") == 0)
            is(r, key, s->loss_factor != NULL ? s->loss_factor[0] : (double)NAN, value);
    }
    wt_sweep_clear(&sweep);
}

static double channel(const wt_segment *s, wt_quantity q, bool last)
{
    const wt_channel *c = wt_segment_channel(s, q);
    return c == NULL ? (double)NAN : c->values[last ? s->n_points - 1 : 0];
}

static void check_segment(reading *r, const char *key, const char *value,
                          const wt_force_curve *curve, const wt_segment *s)
{
    wt_quantity q;
    if (strcmp(key, "segment") == 0)
        is_word(r, key, wt_segment_kind_name(s->kind), value);
    else if (strcmp(key, "points") == 0)
        is(r, key, (double)s->n_points, value);
    else if (strcmp(key, "x") == 0)
        is(r, key, curve->x, value);
    else if (strcmp(key, "duration") == 0)
        is(r, key, s->duration, value);
    else if (strcmp(key, "velocity") == 0)
        is(r, key, s->velocity, value);
    else if (strcmp(key, "force_last") == 0)
        is(r, key, channel(s, WT_Q_FORCE, true), value);
    else if (wt_quantity_find(key, &q) && q != WT_Q_SPRING_CONSTANT && q != WT_Q_SENSITIVITY)
        is(r, key, channel(s, q, false), value);
}

static void check_force(reading *r, const wt_formats *formats, wt_input *input)
{
    wt_force_source *source = NULL;
    wt_force_curve curve = {.n_segments = 0};
    wt_error err = WT_ERROR_INIT;
    int at = -1;
    const wt_segment *s = NULL;
    wt_log *const log = wt_log_new();
    wt_status status = wt_force_open(formats, input, &r->options, log, &source, &err);
    if (item(r, "warning") != NULL)
        check_warning(r, log);
    if (status == WT_OK)
        status = wt_force_next(source, &curve, &err);
    if (!has_status(r, status, &err)) {
        wt_force_close(source);
        wt_force_curve_clear(&curve);
        wt_log_free(log);
        return;
    }
    at = 0;
    for (size_t i = 0; i < r->n; i++) {
        const char *key = r->keys[i], *value = r->values[i];
        if (strcmp(key, "curves") == 0) {
            is(r, key, (double)wt_force_count(source), value);
        } else if (strcmp(key, "at") == 0) {
            const char *comma = strchr(value, ',');
            const size_t segment = comma != NULL ? (size_t)atoi(comma + 1) : 0;
            for (; at < atoi(value); at++)
                if (wt_force_next(source, &curve, &err) != WT_OK)
                    fail(r, "there is no curve %d", at + 1);
            s = segment < curve.n_segments ? &curve.segments[segment] : NULL;
            if (s == NULL)
                fail(r, "there is no segment %s", value);
        } else if (s != NULL) {
            check_segment(r, key, value, &curve, s);
        }
    }
    wt_log_free(log);
    wt_force_close(source);
    wt_force_curve_clear(&curve);
}

static void check_record(reading *r, const wt_formats *formats, wt_input *input)
{
    static const char *const names[WT_RECORD_CHANNELS] = {
        "time",     "distance", "laps",     "position",    "friction_force", "normal_force", "mu",
        "velocity", "rotation", "pressure", "temperature", "wear_depth",     "torque"};
    wt_record record = {.n = 0};
    wt_error err = WT_ERROR_INIT;
    const wt_status status = wt_record_read(formats, input, &r->options, NULL, &record, &err);
    if (!has_status(r, status, &err))
        return;
    for (size_t i = 0; i < r->n; i++) {
        const char *key = r->keys[i], *value = r->values[i];
        if (strcmp(key, "samples") == 0)
            is(r, key, (double)record.n, value);
        else if (strcmp(key, "steps") == 0)
            is(r, key, (double)record.step[record.n - 1] + 1, value);
        else if (strcmp(key, "radius") == 0)
            is(r, key, record.radius, value);
        for (int c = 0; c < WT_RECORD_CHANNELS; c++) {
            const size_t n = strlen(names[c]);
            const double *const x = record.channel[c];
            if (strncmp(key, names[c], n) == 0 && (key[n] == '\0' || strcmp(key + n, "_last") == 0))
                is(r, key, x == NULL ? (double)NAN : x[key[n] == '\0' ? 0 : record.n - 1], value);
        }
    }
    wt_record_clear(&record);
}

static void check_image_number(reading *r, const char *key, const char *value, const wt_image *m)
{
    const size_t n = m->n_columns * m->n_rows;
    size_t missing = 0;
    for (size_t i = 0; i < n; i++)
        missing += isnan(m->values[i]) != 0;
    const struct {
        const char *key;
        double number;
    } numbers[] = {{"wide", (double)m->n_columns},
                   {"high", (double)m->n_rows},
                   {"width", m->width},
                   {"height", m->height},
                   {"x_min", m->x_min},
                   {"missing", (double)missing},
                   {"first", m->values[0]},
                   {"last", m->values[(m->n_rows - 1) * m->n_columns]},
                   {"last_point", m->values[n - 1]}};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        if (strcmp(key, numbers[i].key) == 0)
            is(r, key, numbers[i].number, value);
}

static void check_image(reading *r, const wt_formats *formats, wt_input *input)
{
    wt_image *images = NULL;
    size_t n = 0;
    wt_error err = WT_ERROR_INIT;
    wt_log *log = wt_log_new();
    const wt_status status = wt_images_read(formats, input, &r->options, log, &images, &n, &err);
    if (status == WT_OK && item(r, "warning") != NULL)
        check_warning(r, log);
    wt_log_free(log);
    if (!has_status(r, status, &err))
        return;
    for (size_t i = 0; i < r->n; i++) {
        char wanted[128];
        with_blanks(r->values[i], wanted, sizeof wanted);
        check_image_number(r, r->keys[i], r->values[i], &images[0]);
        if (strcmp(r->keys[i], "name") == 0)
            is_word(r, "name", images[0].name, wanted);
        else if (strcmp(r->keys[i], "unit") == 0)
            is_word(r, "unit", images[0].unit, wanted);
    }
    for (size_t i = 0; i < n; i++)
        wt_image_clear(&images[i]);
    free(images);
}

static void check_spectrum(reading *r, const wt_formats *formats, wt_input *input)
{
    wt_power_spectrum p = {.n = 0};
    wt_error err = WT_ERROR_INIT;
    wt_status status = wt_power_spectrum_read(formats, input, &r->options, NULL, &p, &err);
    if (!has_status(r, status, &err))
        return;
    for (size_t i = 0; i < r->n; i++) {
        const char *key = r->keys[i], *value = r->values[i];
        if (strcmp(key, "spectrum") == 0)
            is_word(r, key, p.kind == WT_SPECTRUM_2D ? "2d" : "1d", value);
        else if (strcmp(key, "points") == 0)
            is(r, key, (double)p.n, value);
        else if (strcmp(key, "w") == 0)
            is(r, key, p.wavenumber[0], value);
        else if (strcmp(key, "w_last") == 0)
            is(r, key, p.wavenumber[p.n - 1], value);
        else if (strcmp(key, "density") == 0)
            is(r, key, p.density[0], value);
    }
    wt_power_spectrum_clear(&p);
}

/* The metadata of `info` name the columns, also if values are missing. */
static void check_facts(reading *r, const wt_formats *formats, wt_input *input)
{
    wt_table *facts = NULL;
    wt_error err = WT_ERROR_INIT;
    size_t columns = 0;
    if (wt_input_describe(formats, input, &r->options, NULL, &facts, &err) != WT_OK) {
        fail(r, "no facts: %s", err.message);
        return;
    }
    for (size_t i = 0; i < wt_table_n_rows(facts); i++)
        columns += strncmp(wt_table_text(facts, i, 0), "column \"", 8) == 0;
    /* The columns of a matrix are equal. */
    const size_t fewest = strcmp(r->kind, "image") == 0 ? 1 : 2;
    if (columns < fewest && item(r, "found") == NULL)
        fail(r, "the facts name %zu columns", columns);
    wt_table_free(facts);
}

static void check(reading *r, const wt_formats *formats, const char *fixtures)
{
    char path[1024];
    wt_input *input = NULL;
    wt_error err = WT_ERROR_INIT;
    const wt_format_info *info = NULL;
    const size_t id_length = strcspn(r->file, "/");
    snprintf(path, sizeof path, "%s/%s", fixtures, r->file);
    if (wt_input_open(path, &input, &err) != WT_OK) {
        fail(r, "%s", err.message);
        return;
    }
    if (wt_format_detect(formats, input, NULL, 0, &info, &err) != WT_OK)
        fail(r, "not recognised: %s, %s", err.message, err.found);
    else if (strlen(info->id) != id_length || strncmp(info->id, r->file, id_length) != 0)
        fail(r, "recognised as %s", info->id);
    take_options(r);
    if (strcmp(r->kind, "sweep") == 0)
        check_sweep(r, formats, input);
    else if (strcmp(r->kind, "force") == 0)
        check_force(r, formats, input);
    else if (strcmp(r->kind, "record") == 0)
        check_record(r, formats, input);
    else if (strcmp(r->kind, "spectrum") == 0)
        check_spectrum(r, formats, input);
    else if (strcmp(r->kind, "image") == 0)
        check_image(r, formats, input);
    else
        fail(r, "unknown kind %s", r->kind);
    check_facts(r, formats, input);
    wt_input_close(input);
}

static void split(reading *r, char *line)
{
    char *rest = NULL;
    r->file = strtok_r(line, " \n", &rest);
    r->kind = strtok_r(NULL, " \n", &rest);
    for (char *word; r->n < ITEMS_MAX && (word = strtok_r(NULL, " \n", &rest)) != NULL;) {
        char *equal = strchr(word, '=');
        if (equal == NULL) {
            fail(r, "\"%s\" is no key=value", word);
            continue;
        }
        *equal = '\0';
        r->keys[r->n] = word;
        r->values[r->n++] = equal + 1;
    }
}

int main(int argc, char *argv[])
{
    static char line[4096];
    wt_formats *formats = NULL;
    wt_error err = WT_ERROR_INIT;
    int failures = 0;
    size_t line_number = 0;
    if (argc != 3 || wt_formats_new(NULL, &formats, NULL, &err) != WT_OK) {
        fprintf(stderr, "cannot start: %s\n", err.message);
        return 1;
    }
    const size_t n = wt_formats_count(formats);
    bool *exercised = calloc(n, sizeof *exercised);
    FILE *expected = fopen(argv[2], "r");
    if (expected == NULL || exercised == NULL) {
        fprintf(stderr, "cannot read %s\n", argv[2]);
        return 1;
    }
    while (fgets(line, sizeof line, expected) != NULL) {
        reading r = {.line = ++line_number};
        if (line[0] == '#' || line[0] == '\n')
            continue;
        split(&r, line);
        if (r.kind == NULL) {
            fprintf(stderr, "expected.txt:%zu: no kind\n", line_number);
            return 1;
        }
        check(&r, formats, argv[1]);
        failures += r.failures;
        for (size_t i = 0; i < n; i++) {
            const char *id = wt_formats_get(formats, i)->id;
            exercised[i] |= strncmp(id, r.file, strlen(id)) == 0 && r.file[strlen(id)] == '/';
        }
    }
    for (size_t i = 0; i < n; i++) {
        const char *id = wt_formats_get(formats, i)->id;
        if (wt_formats_xml(formats, id) != NULL && !exercised[i]) {
            fprintf(stderr, "formats/%s.xml has no fixture in expected.txt\n", id);
            failures++;
        }
    }
    fclose(expected);
    free(exercised);
    wt_formats_free(formats);
    return failures == 0 ? 0 : 1;
}
