/* Detects the kind of a file. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "cmd/file_kind.h"
#include "core/table/registry.h"

const file_kind_missing file_kind_missing_rows[FILE_KIND_N_MISSING] = {
    {"spring-constant", "0.1N/m"}, {"sensitivity", "60nm/V"},  {"temperature", "20degC"},
    {"units", "\"E'=MPa\""},       {"deformation", "tension"}, {"frequency", "10Hz"},
};

void format_metadata_value(const char *value, const char *unit, char *out, size_t size)
{
    enum { DIGITS = 6 };
    static const char *const si[] = {"m", "m/s", "m/V", "N", "N/m", "Pa", "s", "V", "rad/s"};
    double number = 0;
    const bool is_number = wt_number_parse(value, strlen(value), '.', &number);
    const bool has_unit = *unit != '\0' && strcmp(unit, "1") != 0;
    for (size_t i = 0; is_number && i < COUNT_OF(si); i++)
        if (strcmp(unit, si[i]) == 0) {
            char digits[128];
            wt_format_si(number, unit, DIGITS, digits, sizeof digits);
            /* without trailing zeros: 61.0000 mN/m is 61 mN/m */
            const size_t n = strcspn(digits, " e");
            size_t kept = n;
            while (memchr(digits, '.', n) != NULL && kept > 0 && digits[kept - 1] == '0')
                kept--;
            kept -= kept > 0 && digits[kept - 1] == '.';
            snprintf(out, size, "%.*s%s", (int)kept, digits, digits + n);
            return;
        }
    if (is_number && has_unit)
        snprintf(out, size, "%s %s", value, strcmp(unit, "byte") == 0 ? "bytes" : unit);
    else
        snprintf(out, size, "%s", value);
}

/* Metadata items that show the content of a file or that a case needs. */
static const struct {
    const char *item;
    unsigned kind;    /* WT_KIND_* of a file with this item; 0: any */
    const char *next; /* subcommand for the file if the item is the first; NULL: by its kind */
} metadata_items[] = {{"curves", WT_KIND_FORCE, NULL},
                      {"thermal noise", WT_KIND_NOISE, "thermal"},
                      {"record of friction", WT_KIND_RECORD, "record"},
                      {"spring constant", 0, NULL},
                      {"deflection sensitivity", 0, NULL},
                      {"isotherms", WT_KIND_SWEEP, NULL},
                      {"temperature sweeps", WT_KIND_SWEEP, "ramp"},
                      {"strain sweeps", WT_KIND_SWEEP, "payne"},
                      {"deformation", 0, NULL},
                      {"power spectrum", WT_KIND_SPECTRUM, NULL}};

static void read_metadata_item(const char *item, const char *value, const char *unit,
                               const char *source, file_kind *found)
{
    const size_t used = strlen(found->description);
    for (size_t i = 0; i < COUNT_OF(metadata_items); i++) {
        char shown[160];
        if (strcmp(item, metadata_items[i].item) != 0 || strcmp(value, "0") == 0 ||
            strstr(found->description, item) != NULL) /* header value and converted value */
            continue;
        if (found->kind == 0) {
            found->kind = metadata_items[i].kind;
            found->next = metadata_items[i].next;
        }
        format_metadata_value(value, unit, shown, sizeof shown);
        snprintf(found->description + used, sizeof found->description - used, "%s%s %s",
                 strchr(found->description, ',') != NULL || strchr(found->description, ' ') != NULL
                     ? ", "
                     : ": ",
                 item, shown);
    }
    static const char radius[] = "tip radius, "; /* followed by the unit */
    if (strncmp(item, radius, sizeof radius - 1) == 0) {
        const char *of = item + sizeof radius - 1;
        snprintf(found->tip, sizeof found->tip, "sphere:radius=%s%.*s", value,
                 (int)strcspn(of, " "), of);
    }
    const bool unread = strcmp(item, "not readable as it is") == 0;
    found->unread = found->unread || unread;
    found->nothing = found->nothing || (unread && strstr(value, " not read;") != NULL);
    const char *advice = unread ? value : strcmp(item, "missing") == 0 ? source : "";
    for (size_t i = 0; i < FILE_KIND_N_MISSING; i++) {
        char option[32];
        snprintf(option, sizeof option, "--%s", file_kind_missing_rows[i].name);
        found->missing[i] = found->missing[i] || strstr(advice, option) != NULL;
    }
}

static bool starts_with(const char *text, const char *begin)
{
    return strncmp(text, begin, strlen(begin)) == 0;
}

/* Reads the quantities of the columns, and detects heights along one line. */
static void read_column_items(const char *item, const char *value, file_kind *found)
{
    found->has_x |= starts_with(value, "position_x");
    found->has_y |= starts_with(value, "position_y");
    found->has_force |= starts_with(value, "friction_force");
    found->has_load |=
        starts_with(value, "normal_force") || starts_with(value, "friction_coefficient");
    found->one_row |= starts_with(item, "image ") && strstr(value, " x 1 pixels") != NULL;
}

bool file_kind_is_missing(const file_kind *found, size_t missing)
{
    const bool by_column =
        *found->unitless != '\0' && strcmp(file_kind_missing_rows[missing].name, "units") == 0;
    return found->missing[missing] && !by_column;
}

/* Stores the name of a column without a unit, which needs its own --units. */
static void read_unitless_column(const char *item, const char *value, file_kind *found)
{
    static const char column[] = "column \"";
    const size_t used = strlen(found->unitless), begin = sizeof column - 1, length = strlen(item);
    if (strncmp(item, column, begin) == 0 && strstr(value, "give --units") != NULL &&
        length - begin + used < sizeof found->unitless)
        snprintf(found->unitless + used, sizeof found->unitless - used, "%.*s\n",
                 (int)(length - begin - 1), item + begin);
}

static void read_metadata(const wt_formats *formats, const wt_table *metadata, file_kind *found)
{
    const wt_format_info *format = NULL;
    for (size_t row = 0; row < wt_table_n_rows(metadata); row++) {
        const char *item = wt_table_text(metadata, row, FACTS_ITEM);
        const char *value = wt_table_text(metadata, row, FACTS_VALUE);
        if (format == NULL && strcmp(item, "format") == 0) {
            format = wt_formats_find(formats, value);
            snprintf(found->description, sizeof found->description, "%s", value);
        }
        found->is_result = found->is_result || strncmp(item, "table ", 6) == 0;
        read_unitless_column(item, value, found);
        read_column_items(item, value, found);
        read_metadata_item(item, value, wt_table_text(metadata, row, FACTS_UNIT),
                           wt_table_text(metadata, row, FACTS_SOURCE), found);
    }
    /* no command reads a file whose fault no option mends */
    bool can_mend = *found->unitless != '\0';
    for (size_t i = 0; i < FILE_KIND_N_MISSING; i++)
        can_mend = can_mend || found->missing[i];
    found->nothing = found->nothing || (found->unread && found->kind == 0 && !can_mend);
    found->is_result =
        found->is_result && format != NULL && strncmp(format->id, "weartrack-", 10) == 0;
    /* a file that is not readable yet does not show its kind */
    if (found->kind == 0 && format != NULL && !found->is_result)
        found->kind = format->kinds & (~format->kinds + 1);
    if (format != NULL && found->kind == WT_KIND_FORCE && (format->kinds & WT_KIND_IMAGE) != 0 &&
        strstr(found->description, "curves") == NULL)
        found->kind = WT_KIND_IMAGE;
}

wt_status file_kind_detect(cmd_session *s, const char *path, const wt_read_options *options,
                           wt_log *log, wt_table **metadata, file_kind *found)
{
    wt_input *input = NULL;
    *found = (file_kind){0};
    wt_status status = wt_input_open(path, &input, &s->err);
    if (status == WT_OK)
        status = wt_input_describe(s->formats, input, options, log, metadata, &s->err);
    if (status == WT_OK)
        read_metadata(s->formats, *metadata, found);
    else
        wt_error_file(&s->err, path);
    wt_input_close(input);
    return status;
}
