/* Parses, checks and formats the parameters of an option structure. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#include "core/base/param.h"
#include "core/base/quantity.h"
#include "core/base/text.h"

#include <stdalign.h>
#include <stdlib.h>
#include <string.h>

/* ---- table of parameters --------------------------------------------------------------------- */

size_t wt_params_count(const wt_params *params)
{
    size_t n = params->n_records;
    for (size_t i = 0; i < PARAM_PARTS && params->part[i].params != NULL; i++)
        n += wt_params_count(params->part[i].params());
    return n;
}

/* Returns record i and adds the offset of the structure that it belongs to. */
static const wt_param *find_param_record(const wt_params *params, size_t i, size_t *offset)
{
    if (i < params->n_records)
        return &params->records[i];
    i -= params->n_records;
    for (size_t k = 0; k < PARAM_PARTS && params->part[k].params != NULL; k++) {
        const size_t n = wt_params_count(params->part[k].params());
        if (i < n) {
            *offset += params->part[k].offset;
            return find_param_record(params->part[k].params(), i, offset);
        }
        i -= n;
    }
    return NULL;
}

const wt_param *wt_params_get(const wt_params *params, size_t i)
{
    size_t offset = 0;
    return find_param_record(params, i, &offset);
}

/* Number of the parameter with this name, or with this name in an earlier version. That of all if
 * there is none. */
static size_t param_index(const wt_params *params, const char *name)
{
    const size_t n = wt_params_count(params);
    for (size_t i = 0; i < n; i++) {
        const wt_param *const p = wt_params_get(params, i);
        if (strcmp(p->name, name) == 0 || (p->former != NULL && strcmp(p->former, name) == 0))
            return i;
    }
    return n;
}

/* ---- members --------------------------------------------------------------------------------- */

/* Member of a structure with its parameter record. */
typedef struct bound_member {
    const wt_param *param;
    void *member;
    size_t *count; /* number of elements of a list */
} bound_member;

static bound_member bind_member(const wt_params *params, size_t i, void *structure)
{
    size_t offset = 0;
    const wt_param *param = find_param_record(params, i, &offset);
    char *base = (char *)structure + offset;
    return (bound_member){param, base + param->offset, (void *)(base + param->count_offset)};
}

static unsigned long long read_unsigned_member(const bound_member *s)
{
    unsigned narrow = 0;
    unsigned long long wide = 0;
    if (s->param->size == sizeof wide)
        memcpy(&wide, s->member, sizeof wide);
    else
        memcpy(&narrow, s->member, sizeof narrow);
    return wide + narrow;
}

static void write_unsigned_member(const bound_member *s, unsigned long long value)
{
    const unsigned narrow = (unsigned)value;
    if (s->param->size == sizeof value)
        memcpy(s->member, &value, sizeof value);
    else
        memcpy(s->member, &narrow, sizeof narrow);
}

/* ---- limits ---------------------------------------------------------------------------------- */

/* False for NaN. */
static bool is_within_limits(const wt_param *param, double value)
{
    const param_limits *l = &param->limits;
    return (l->with_low ? value >= l->low : value > l->low) &&
           (l->with_high ? value <= l->high : value < l->high) &&
           quantity_is_plausible(param->quantity, value);
}

/* Example: "above 0 Pa, up to 1 Pa". */
static void format_limits(const wt_param *param, char *buffer, size_t size)
{
    const param_limits *l = &param->limits;
    const char *unit = wt_quantity_unit(param->quantity);
    const char *gap = strcmp(unit, "1") == 0 ? "" : " ";
    if (*gap == '\0')
        unit = "";
    if (isinf(l->low))
        snprintf(buffer, size, "a finite number");
    else if (isinf(l->high))
        clocale_print(buffer, size, l->with_low ? "%g%s%s or more" : "above %g%s%s", l->low, gap,
                      unit);
    else
        clocale_print(buffer, size, "%s%g%s%g%s%s", l->with_low ? "" : "above ", l->low,
                      !l->with_high ? " to below "
                      : l->with_low ? " to "
                                    : ", up to ",
                      l->high, gap, unit);
}

static wt_status range_failure(const wt_param *param, double value, const char *found,
                               wt_error *err)
{
    char text[128];
    const param_limits *l = &param->limits;
    if (value > l->low && value < l->high && isfinite(value))
        return quantity_implausible_error(param->quantity, found, err);
    format_limits(param, text, sizeof text);
    wt_fail(err, WT_E_RANGE, "out of range");
    wt_error_expected(err, "%s", text);
    wt_error_found(err, "%s", found);
    return WT_E_RANGE;
}

/* ---- parsing --------------------------------------------------------------------------------- */

/* Checks a value that was parsed. The error message contains the text as it was written. */
static wt_status check_read_value(const wt_param *param, double value, const char *text,
                                  wt_error *err)
{
    if (is_within_limits(param, value))
        return WT_OK;
    return range_failure(param, value, text, err);
}

static wt_status parse_estimate_value(const wt_param *param, const char *text,
                                      wt_estimate *estimate, wt_error *err)
{
    wt_estimate read = {0};
    wt_status status = estimate_parse(text, param->quantity, param->example, &read, err);
    if (status == WT_OK)
        status = check_read_value(param, read.value, text, err);
    if (status == WT_OK)
        *estimate = read;
    return status;
}

/* A stated error that is not used is rejected, because it would be ignored silently. */
static wt_status parse_number_value(const wt_param *param, const char *text, double *value,
                                    wt_error *err)
{
    wt_estimate read = {0};
    wt_status status = parse_estimate_value(param, text, &read, err);
    if (status == WT_OK && read.standard_error > 0) {
        status = wt_fail(err, WT_E_ARG, "an error stated here would not be used");
        wt_error_found(err, "%s", text);
        wt_error_advice(err, "leave out what follows +-");
    }
    if (status == WT_OK)
        *value = read.value;
    return status;
}

static wt_status parse_list_member(const bound_member *s, const char *text, wt_error *err)
{
    double *values = NULL;
    size_t n = 0;
    wt_status status = list_parse(text, s->param->quantity, s->param->example, &values, &n, err);
    for (size_t i = 0; status == WT_OK && i < n; i++)
        status = check_read_value(s->param, values[i], text, err);
    if (status != WT_OK) {
        free(values);
        return status;
    }
    *(const double **)s->member = values;
    *s->count = n;
    return WT_OK;
}

static wt_status parse_count_member(const bound_member *s, const char *text, wt_error *err)
{
    const unsigned long long most = s->param->size == sizeof most ? UINT64_MAX : UINT32_MAX;
    unsigned long long value = 0;
    bool good = *text != '\0';
    for (const char *p = text; *p != '\0' && good; p++) {
        const unsigned long long digit = (unsigned long long)*p - '0';
        good = *p >= '0' && *p <= '9' && value <= (most - digit) / 10;
        value = value * 10 + digit;
    }
    if (!good)
        return wt_fail(err, WT_E_ARG, "'%s' is not an integer, or too large", text);
    wt_status status = check_read_value(s->param, (double)value, text, err);
    if (status == WT_OK)
        write_unsigned_member(s, value);
    return status;
}

static size_t count_choices(const wt_param *param)
{
    size_t n = 1;
    for (const char *p = param->value; *p != '\0'; p++)
        n += *p == '|';
    return n;
}

/* True if the text resembles the name of a spreadsheet format. */
static bool is_spreadsheet(const char *text, size_t length)
{
    spell_suggestion near = spell_suggestion_begin(text, length);
    spell_suggestion_try(&near, "excel", sizeof "excel" - 1);
    spell_suggestion_try(&near, "xlsx", sizeof "xlsx" - 1);
    return near.name != NULL;
}

static wt_status parse_choice_member(const bound_member *s, const char *choices, const char *text,
                                     wt_error *err)
{
    const size_t length = strlen(text);
    spell_suggestion near = spell_suggestion_begin(text, length);
    unsigned i = 0;
    for (const char *p = choices;; i++) {
        const size_t word = strcspn(p, "|");
        if (word == length && strncmp(p, text, word) == 0)
            break;
        spell_suggestion_try(&near, p, word);
        if (p[word] == '\0') {
            (void)wt_fail(err, WT_E_ARG, "'%s' is not one of %s", text, choices);
            if (near.name != NULL)
                wt_error_advice(err, "did you mean '%.*s'?", (int)near.name_length, near.name);
            else if (strstr(choices, "csv") != NULL && is_spreadsheet(text, length))
                wt_error_advice(err, "a spreadsheet opens 'csv'");
            return WT_E_ARG;
        }
        p += word + 1;
    }
    write_unsigned_member(s, i);
    return WT_OK;
}

/* If the placeholder of the value is "NAME=UNIT", both sides of the "=" are required. */
static bool is_valid_item(const wt_param *param, const char *text)
{
    const char *equals = strchr(text, '=');
    return *text != '\0' && (param->value == NULL || strchr(param->value, '=') == NULL ||
                             (equals != NULL && equals != text && equals[1] != '\0'));
}

/* Appends the items of a text. Pairs are separated by ';'; a file name is not split, because it may
 * contain any character. */
static wt_status append_text_items(const bound_member *s, const char *text, wt_error *err)
{
    const char *const **list = s->member;
    const char *part = strchr(s->param->value, '=') != NULL ? ";" : "";
    for (const char *begin = text;; begin++) {
        const char *end = begin + strcspn(begin, part);
        begin += strspn(begin, *part != '\0' ? " \t\r\n" : "");
        char *item = wt_strndup(begin, begin < end ? (size_t)(end - begin) : 0);
        if (!is_valid_item(s->param, item)) {
            wt_fail(err, WT_E_ARG, "'%s' is not %s", item, s->param->value);
            free(item);
            return WT_E_ARG;
        }
        const char **grown = wt_realloc((void *)*list, *s->count + 1, sizeof *grown);
        grown[*s->count] = item;
        *s->count += 1;
        *list = grown;
        if (*end == '\0')
            return WT_OK;
        begin = end;
    }
}

static void clear_list(const bound_member *s)
{
    if (s->param->kind == PARAM_LIST) {
        const double **values = s->member;
        free((void *)*values);
        *values = NULL;
        *s->count = 0;
    } else if (s->param->kind == PARAM_TEXTS) {
        const char *const **texts = s->member;
        wt_strings_free((char **)*texts, *s->count);
        *texts = NULL;
        *s->count = 0;
    }
}

static wt_status parse_member(const bound_member *s, const char *text, wt_error *err)
{
    switch (s->param->kind) {
    case PARAM_NUMBER:
        return parse_number_value(s->param, text, s->member, err);
    case PARAM_ESTIMATE:
        return parse_estimate_value(s->param, text, s->member, err);
    case PARAM_LIST:
        return parse_list_member(s, text, err);
    case PARAM_COUNT:
        return parse_count_member(s, text, err);
    case PARAM_CHOICE:
        return parse_choice_member(s, s->param->value, text, err);
    case PARAM_TEXT:
        *(const char **)s->member = text;
        return WT_OK;
    case PARAM_TEXTS:
        return append_text_items(s, text, err);
    case PARAM_OTHER:
        return s->param->read(text, s->member, err);
    case PARAM_FLAG:
        break;
    }
    const bool yes = strcmp(text, "yes") == 0;
    if (!yes && strcmp(text, "no") != 0)
        return wt_fail(err, WT_E_ARG, "'%s' is neither yes nor no", text);
    *(bool *)s->member = yes;
    return WT_OK;
}

wt_status wt_params_set(const wt_params *params, const char *name, void *structure,
                        const char *text, uint64_t *given, wt_error *err)
{
    const size_t i = param_index(params, name);
    if (i == wt_params_count(params))
        return wt_fail(err, WT_E_NOT_FOUND, "there is no parameter '%s'", name);
    const bound_member s = bind_member(params, i, structure);
    const uint64_t bit = UINT64_C(1) << i;
    if (*text == '\0')
        return wt_fail(err, WT_E_ARG, "the value is empty");
    if (s.param->kind == PARAM_TEXTS && (*given & bit) == 0) {
        *(const char *const **)s.member =
            NULL; /* the caller must not free or extend the default list */
        *s.count = 0;
    }
    if (s.param->kind == PARAM_LIST && (*given & bit) != 0)
        clear_list(&s);
    *given |= bit;
    wt_status status = parse_member(&s, text, err);
    return status == WT_OK && s.param->check != NULL ? s.param->check(s.member, err) : status;
}

void param_copy(const wt_params *params, const void *from, uint64_t given, void *to)
{
    for (size_t i = 0; i < params->n_records; i++) {
        const wt_param *const p = &params->records[i];
        if ((given & UINT64_C(1) << i) != 0)
            memcpy((char *)to + p->offset, (const char *)from + p->offset, p->size);
    }
}

const char *param_find_missing(const wt_params *params, uint64_t given)
{
    const size_t n = wt_params_count(params);
    for (size_t i = 0; i < n; i++) {
        const wt_param *param = wt_params_get(params, i);
        if ((param->flags & PARAM_REQUIRED) != 0 && (given & UINT64_C(1) << i) == 0)
            return param->name;
    }
    return NULL;
}

void wt_params_clear(const wt_params *params, void *structure, uint64_t *given)
{
    const size_t n = wt_params_count(params);
    for (size_t i = 0; i < n; i++) {
        const bound_member s = bind_member(params, i, structure);
        if ((*given & UINT64_C(1) << i) != 0)
            clear_list(&s);
    }
    *given = 0;
}

/* ---- checking and formatting ----------------------------------------------------------------- */

/* True if the member has no value: NaN, NULL or an empty list. */
static bool is_unset(const bound_member *s)
{
    switch (s->param->kind) {
    case PARAM_NUMBER:
        return isnan(*(const double *)s->member);
    case PARAM_ESTIMATE:
        return isnan(((const wt_estimate *)s->member)->value);
    case PARAM_LIST:
    case PARAM_TEXTS:
        return *s->count == 0;
    case PARAM_TEXT:
        return *(const char **)s->member == NULL;
    default:
        return false;
    }
}

static wt_status check_values_in_range(const wt_param *p, const double *values, size_t n,
                                       wt_error *err)
{
    for (size_t i = 0; i < n; i++)
        if (!is_within_limits(p, values[i])) {
            char found[32];
            clocale_print(found, sizeof found, "%g", values[i]);
            return range_failure(p, values[i], found, err);
        }
    return WT_OK;
}

wt_status range_error(const char *name, double value, const char *expected, wt_error *err)
{
    wt_fail(err, WT_E_RANGE, "%s is outside its range", name);
    wt_error_expected(err, "%s", expected);
    wt_error_found(err, "%g", value);
    return WT_E_RANGE;
}

wt_status param_check_number(const wt_param *param, double value, wt_error *err)
{
    wt_status status = check_values_in_range(param, &value, 1, err);
    if (status != WT_OK)
        wt_error_place(err, "%s", param->name);
    return status;
}

static wt_status check_member_value(const bound_member *s, wt_error *err)
{
    const wt_param *p = s->param;
    wt_status status = WT_OK;
    const bool is_number = p->kind == PARAM_NUMBER || p->kind == PARAM_ESTIMATE;
    if (is_unset(s) && p->unset != NULL)
        return WT_OK;
    if (is_unset(s) && (!is_number || (p->flags & PARAM_REQUIRED) != 0))
        return wt_fail(err, WT_E_MISSING, "missing");
    switch (p->kind) {
    case PARAM_NUMBER:
    case PARAM_ESTIMATE: /* the value is the first member of the estimate */
        status = check_values_in_range(p, s->member, 1, err);
        break;
    case PARAM_LIST:
        status = check_values_in_range(p, *(const double **)s->member, *s->count, err);
        break;
    case PARAM_COUNT:
        status = check_values_in_range(p, &(double){(double)read_unsigned_member(s)}, 1, err);
        break;
    case PARAM_CHOICE:
        if (read_unsigned_member(s) >= count_choices(p))
            status = wt_fail(err, WT_E_RANGE, "%llu is not one of %s", read_unsigned_member(s),
                             p->value);
        break;
    default:
        break;
    }
    return status == WT_OK && p->check != NULL ? p->check(s->member, err) : status;
}

wt_status param_check(const wt_params *params, const void *structure, wt_error *err)
{
    const size_t n = wt_params_count(params);
    for (size_t i = 0; i < n; i++) {
        const bound_member s = bind_member(params, i, (void *)(uintptr_t)structure);
        wt_status status = check_member_value(&s, err);
        if (status != WT_OK) {
            wt_error_place(err, "%s", s.param->name);
            return status;
        }
    }
    return WT_OK;
}

static int format_default_number(const wt_param *param, double value, char *buffer, size_t size)
{
    if (param->quantity == WT_Q_TEMPERATURE)
        return (int)wt_format_si(value, "degC", 3, buffer, size);
    const char *unit = wt_quantity_unit(param->quantity);
    const bool bare = strcmp(unit, "1") == 0;
    return clocale_print(buffer, size, "%g%s%s", value, bare ? "" : " ", bare ? "" : unit);
}

static int format_choice(const wt_param *param, unsigned long long value, char *buffer, size_t size)
{
    const char *word = param->value;
    for (unsigned long long i = value; i > 0; i--)
        word += strcspn(word, "|") + 1;
    return snprintf(buffer, size, "%.*s", (int)strcspn(word, "|"), word);
}

void param_choice_name(const wt_params *params, const char *name, unsigned value, char *buffer,
                       size_t size)
{
    const size_t i = param_index(params, name);
    const wt_param *p = i < wt_params_count(params) ? wt_params_get(params, i) : NULL;
    buffer[0] = '\0';
    if (p != NULL && p->kind == PARAM_CHOICE && value < count_choices(p))
        (void)format_choice(p, value, buffer, size);
}

static int format_member(const bound_member *s, char *buffer, size_t size)
{
    const wt_param *p = s->param;
    if (is_unset(s))
        return snprintf(buffer, size, "%s", p->unset != NULL ? p->unset : "");
    switch (p->kind) {
    case PARAM_NUMBER:
    case PARAM_ESTIMATE:
        return format_default_number(p, *(const double *)s->member, buffer, size);
    case PARAM_COUNT:
        return snprintf(buffer, size, "%llu", read_unsigned_member(s));
    case PARAM_FLAG:
        return snprintf(buffer, size, "%s", *(const bool *)s->member ? "yes" : "no");
    case PARAM_CHOICE:
        return format_choice(p, read_unsigned_member(s), buffer, size);
    case PARAM_TEXT:
        return snprintf(buffer, size, "%s", *(const char **)s->member);
    default:
        return snprintf(buffer, size, "%s", p->unset != NULL ? p->unset : "");
    }
}

bool wt_params_default_flag(const wt_params *params, size_t i)
{
    alignas(max_align_t) unsigned char structure[PARAM_STRUCTURE_SIZE_MAX] = {0};
    params->defaults(structure);
    const bound_member s = bind_member(params, i, structure);
    return s.param->kind == PARAM_FLAG && *(const bool *)s.member;
}

size_t wt_params_default(const wt_params *params, size_t i, char *buffer, size_t size)
{
    alignas(max_align_t) unsigned char structure[PARAM_STRUCTURE_SIZE_MAX] = {0};
    params->defaults(structure);
    const bound_member s = bind_member(params, i, structure);
    buffer[0] = '\0';
    const int n = (s.param->flags & PARAM_REQUIRED) != 0 ? 0 : format_member(&s, buffer, size);
    return n > 0 ? (size_t)n : 0;
}
