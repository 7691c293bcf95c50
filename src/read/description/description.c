/* Implements format descriptions and the quantities that each kind of data requires.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "read/description/description.h"
#include "core/base/memory.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

void description_free(text_description *d)
{
    if (d == NULL)
        return;
    for (line_pattern *pattern = d->patterns; pattern != NULL; pattern = pattern->next)
        regfree(&pattern->regex);
    for (size_t i = 0; i < DESCRIPTION_EXTENTS; i++)
        description_free(d->loaded[i]);
    arena_free(&d->memory);
    free(d);
}

bool description_find_name(const text_description *d, const char *name, size_t *first, size_t *n)
{
    size_t low = 0, high = d->n_names;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (strcmp(d->names[middle].name, name) < 0)
            low = middle + 1;
        else
            high = middle;
    }
    *first = low;
    *n = 0;
    while (low + *n < d->n_names && strcmp(d->names[low + *n].name, name) == 0)
        (*n)++;
    return *n > 0;
}

header_value find_header_value(wt_quantity quantity, field_sets sets)
{
    static const wt_quantity quantities[HEADER_VALUE_FACTOR] = {
        [HEADER_TEMPERATURE] = WT_Q_TEMPERATURE,
        [HEADER_ANGULAR_FREQUENCY] = WT_Q_ANGULAR_FREQUENCY,
        [HEADER_SPRING_CONSTANT] = WT_Q_SPRING_CONSTANT,
        [HEADER_SENSITIVITY] = WT_Q_SENSITIVITY,
        [HEADER_POSITION_X] = WT_Q_POSITION_X,
        [HEADER_POSITION_Y] = WT_Q_POSITION_Y,
        [HEADER_VELOCITY] = WT_Q_VELOCITY,
        [HEADER_DURATION] = WT_Q_TIME,
        [HEADER_SETPOINT] = WT_Q_FORCE,
        [HEADER_LOAD] = WT_Q_NORMAL_FORCE,
        [HEADER_RADIUS] = WT_Q_LENGTH};
    header_value value = HEADER_TEMPERATURE;
    if (sets >= FIELD_SETS_VALUE_FACTOR)
        return quantity == WT_Q_LENGTH
                   ? (header_value)(HEADER_VALUE_FACTOR + (sets - FIELD_SETS_VALUE_FACTOR))
                   : HEADER_COUNT;
    while (value < HEADER_VALUE_FACTOR && quantities[value] != quantity)
        value++;
    return value < HEADER_VALUE_FACTOR ? value : HEADER_COUNT;
}

bool pattern_match(const line_pattern *pattern, text_span line, regmatch_t *groups, size_t n)
{
    if (line.length > PATTERN_LINE_MAX ||
        (pattern->first != '\0' && line.text[0] != pattern->first))
        return false;
    const int code = regexec(&pattern->regex, line.text, n, groups, 0);
    if (code == REG_ESPACE)
        resource_error_note(ENOMEM);
    return code == 0;
}

text_span pattern_group(text_span line, regmatch_t group)
{
    return (text_span){line.text + group.rm_so, (size_t)(group.rm_eo - group.rm_so)};
}

bool pattern_extract(const line_pattern *pattern, text_span *line)
{
    regmatch_t groups[2] = {{-1, -1}, {-1, -1}};
    if (!pattern_match(pattern, *line, groups, 2) || groups[1].rm_so < 0)
        return false;
    *line = pattern_group(*line, groups[1]);
    return true;
}

/* ---- kinds -------------------------------------------------------------------------------- */

#define Q(quantity) WT_Q_BIT(WT_Q_##quantity)

/* A kind of data requires one quantity of each group of a row. */
static const struct {
    unsigned kind;
    const char *name, *required_columns;
    wt_quantity_set groups[3];
} requirements[] = {
    {WT_KIND_FORCE,
     "force",
     "columns of height and of force or deflection",
     {Q(HEIGHT) | Q(MEASURED_HEIGHT), Q(FORCE) | Q(DEFLECTION) | Q(DEFLECTION_VOLTAGE)}},
    {WT_KIND_SWEEP,
     "sweep",
     "columns of frequency, and of storage and loss modulus (or |E*|, or loss factor), or one of "
     "them",
     {Q(FREQUENCY) | Q(ANGULAR_FREQUENCY), Q(STORAGE_MODULUS) | Q(LOSS_MODULUS) | Q(LOSS_FACTOR) |
                                               Q(SHEAR_STORAGE_MODULUS) | Q(SHEAR_LOSS_MODULUS)}},
    {WT_KIND_SWEEP,
     "sweep",
     "columns of frequency and complex modulus, and of loss modulus, loss factor or phase angle",
     {Q(FREQUENCY) | Q(ANGULAR_FREQUENCY), Q(COMPLEX_MODULUS) | Q(SHEAR_COMPLEX_MODULUS),
      Q(LOSS_MODULUS) | Q(SHEAR_LOSS_MODULUS) | Q(LOSS_FACTOR) | Q(PHASE)}},
    {WT_KIND_SWEEP,
     "sweep",
     "columns of strain or temperature, and of storage and loss modulus, and the frequency",
     {Q(STRAIN) | Q(TEMPERATURE),
      Q(STORAGE_MODULUS) | Q(SHEAR_STORAGE_MODULUS) | Q(COMPLEX_MODULUS) | Q(SHEAR_COMPLEX_MODULUS),
      Q(LOSS_MODULUS) | Q(SHEAR_LOSS_MODULUS) | Q(LOSS_FACTOR) | Q(PHASE)}},
    {WT_KIND_SWEEP,
     "sweep",
     "columns of time, and of relaxation modulus or creep compliance",
     {Q(TIME), Q(RELAXATION_MODULUS) | Q(SHEAR_RELAXATION_MODULUS) | Q(CREEP_COMPLIANCE) |
                   Q(SHEAR_CREEP_COMPLIANCE)}},
    {WT_KIND_IMAGE,
     "image",
     "columns of the lateral position x and of the height of a surface",
     {Q(POSITION_X), Q(SURFACE_HEIGHT)}},
    {WT_KIND_SPECTRUM,
     "spectrum",
     "columns of wavenumber and power spectrum",
     {Q(WAVENUMBER), Q(POWER_SPECTRUM_2D) | Q(POWER_SPECTRUM_1D)}},
    {WT_KIND_RECORD,
     "record",
     "columns of time, distance or laps, and of friction force, torque or coefficient",
     {Q(TIME) | Q(SLIDING_DISTANCE) | Q(LAPS),
      Q(FRICTION_COEFFICIENT) | Q(FRICTION_FORCE) | Q(TORQUE)}},
};
enum { N_REQUIREMENTS = sizeof requirements / sizeof *requirements, N_REQUIRED_GROUPS = 3 };

bool quantities_suffice(wt_quantity_set set, unsigned kinds)
{
    for (size_t i = 0; i < N_REQUIREMENTS; i++) {
        bool all = (requirements[i].kind & kinds) != 0;
        for (size_t g = 0; g < N_REQUIRED_GROUPS; g++)
            all = all && (requirements[i].groups[g] == 0 || (requirements[i].groups[g] & set) != 0);
        if (all)
            return true;
    }
    return false;
}

wt_quantity_set kind_quantities(unsigned kind)
{
    wt_quantity_set set = 0;
    for (size_t i = 0; i < N_REQUIREMENTS; i++)
        for (size_t g = 0; g < N_REQUIRED_GROUPS && requirements[i].kind == kind; g++)
            set |= requirements[i].groups[g];
    return set;
}

static size_t kind_index(unsigned kind)
{
    size_t i = 0;
    while (i + 1 < N_REQUIREMENTS && requirements[i].kind != kind)
        i++;
    return i;
}

const char *describe_required_columns(unsigned kind)
{
    return requirements[kind_index(kind)].required_columns;
}

const char *kind_name(unsigned kind)
{
    return requirements[kind_index(kind)].name;
}

/* ---- checks ---------------------------------------------------------------------------------- */

static bool alias_is_unit(const text_description *d, const char *unit)
{
    double factor, offset;
    for (size_t i = 0; i < d->n_rules; i++)
        if (wt_unit_to_si(unit, d->rules[i].quantity, &factor, &offset, NULL) == WT_OK)
            return true;
    for (size_t i = 0; i < d->n_fields; i++)
        if (d->fields[i].quantity != WT_Q_NONE &&
            wt_unit_to_si(unit, d->fields[i].quantity, &factor, &offset, NULL) == WT_OK)
            return true;
    return false;
}

static wt_status fail_element(wt_error *err, const char *name, const char *element)
{
    wt_error_file(err, name);
    wt_error_place(err, "element %s", element);
    wt_error_advice(err, "see weartrack-format(5)");
    return WT_E_SCHEMA;
}

wt_status description_check_whole(const text_description *d, const char *name, wt_error *err)
{
    wt_quantity_set set = 0;
    for (size_t i = 0; i < d->n_rules; i++)
        set |= WT_Q_BIT(d->rules[i].quantity);
    if (d->matrix && (d->kinds != WT_KIND_IMAGE || d->n_rules != 1)) {
        wt_fail(err, WT_E_SCHEMA, "the rows of a matrix are lines of an image");
        wt_error_expected(err, "kinds=\"image\" and one column, that of the values");
        return fail_element(err, name, "table");
    }
    for (unsigned kind = 1; kind <= WT_KIND_RECORD && !d->matrix; kind *= 2)
        if ((d->kinds & kind) != 0 && !quantities_suffice(set, kind)) {
            wt_fail(err, WT_E_SCHEMA, "the columns do not make %s %s",
                    kind == WT_KIND_IMAGE ? "an" : "a", kind_name(kind));
            wt_error_expected(err, "%s", describe_required_columns(kind));
            return fail_element(err, name, "table");
        }
    for (size_t i = 0; i < d->n_aliases; i++)
        if (!alias_is_unit(d, d->aliases[i].means)) {
            wt_fail(err, WT_E_SCHEMA, "not a unit of any column");
            wt_error_expected(err, "a unit of one of the quantities");
            wt_error_found(err, "means=\"%s\"", d->aliases[i].means);
            return fail_element(err, name, "unit");
        }
    for (size_t i = 1; i < d->n_names; i++) {
        const column_name *a = &d->names[i - 1], *b = &d->names[i];
        if (strcmp(a->name, b->name) == 0 && a->rule == b->rule) {
            wt_fail(err, WT_E_SCHEMA, "a name stands twice in one column");
            wt_error_found(err, "\"%s\" (compared in lower case without blanks)", b->name);
            return fail_element(err, name, "column");
        }
    }
    if ((d->kinds & WT_KIND_SWEEP) == 0 && (d->group != NULL || d->n_samples > 0 ||
                                            d->n_repeating > 0 || !isnan(d->temperature_jump))) {
        wt_fail(err, WT_E_SCHEMA, "isotherms without a sweep");
        wt_error_expected(err, "kinds with sweep in it");
        return fail_element(err, name, "isotherms");
    }
    if (((d->kinds & WT_KIND_FORCE) == 0 &&
         (d->n_markers > 0 || d->n_values > 0 || d->turning_point)) ||
        ((d->kinds & (WT_KIND_FORCE | WT_KIND_RECORD)) == 0 && d->curve_column != NULL)) {
        wt_fail(err, WT_E_SCHEMA, "segments without a force curve");
        wt_error_expected(err, "kinds with force in it");
        return fail_element(err, name, "segments");
    }
    return WT_OK;
}

/* ---- names ----------------------------------------------------------------------------------- */

/* Different spellings that instruments and spreadsheets use for the same symbol. */
static const struct {
    const char *found, *spelled;
} spellings[] = {
    {"\"", "''"},
    {"\xe2\x80\xb3", "''"}, /* double prime */
    {"\xe2\x80\x9d", "''"}, /* right double quotation mark */
    {"\xe2\x80\x9c", "''"}, /* left double quotation mark */
    {"\xe2\x80\xb2", "'"},  /* prime */
    {"\xe2\x80\x99", "'"},  /* right single quotation mark */
    {"\xe2\x80\x98", "'"},  /* left single quotation mark */
    {"\xc2\xb4", "'"},      /* acute accent */
    {"`", "'"},
    {"\xc2\xa0", ""},     /* no-break space */
    {"\xe2\x80\xaf", ""}, /* narrow no-break space */
    {"\xce\xb4", "delta"},
    {"\xce\x94", "delta"},
    {"\xcf\x89", "omega"},
    {"\xce\xb7", "eta"},
    {"\xce\xb3", "gamma"},
    {"\xce\xb5", "epsilon"},
    {"\xcf\x83", "sigma"},
    {"\xcf\x84", "tau"},
    {"\xcf\x86", "phi"},
    {"\xce\xb8", "theta"},
    {"\xce\xbc", "u"}, /* Greek mu */
    {"\xc2\xb5", "u"}, /* micro sign */
    {"\xc2\xb2", "^2"},
    {"\xc2\xb3", "^3"},
    {"\xe2\x81\xb4", "^4"},
};

/* Returns the normalised spelling of the beginning of a text, or NULL, and the original length. */
static const char *canonical_spelling(const char *text, size_t length, size_t *used)
{
    if ((unsigned char)*text < 0x80 && *text != '"' && *text != '`')
        return NULL;
    for (size_t s = 0; s < sizeof spellings / sizeof *spellings; s++) {
        if (*spellings[s].found != *text)
            continue;
        *used = strlen(spellings[s].found);
        if (length >= *used && memcmp(text, spellings[s].found, *used) == 0)
            return spellings[s].spelled;
    }
    return NULL;
}

void name_normalise(text_span text, char name[COLUMN_NAME_SIZE])
{
    size_t out = 0;
    for (size_t i = 0, used; i < text.length; i += used) {
        const char *piece = canonical_spelling(text.text + i, text.length - i, &used);
        const size_t written = piece != NULL ? strlen(piece) : 1;
        char c = text.text[i];
        if (piece == NULL) {
            used = 1;
            if (c == ' ' || (c >= '\t' && c <= '\r'))
                continue;
            c = c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
            piece = &c;
        }
        if (out + written >= COLUMN_NAME_SIZE)
            break;
        memcpy(name + out, piece, written);
        out += written;
    }
    name[out] = '\0';
}

bool name_equals(text_span text, const char *name)
{
    char own[COLUMN_NAME_SIZE];
    name_normalise(text, own);
    return strcmp(own, name) == 0;
}
