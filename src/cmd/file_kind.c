/* Detects the kind of a file. SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <string.h>

#include "cmd/file_kind.h"
#include "core/table/registry.h"

const file_kind_missing file_kind_missing_rows[FILE_KIND_N_MISSING] = {
    {"spring-constant", "0.1N/m"}, {"sensitivity", "60nm/V"},
    {"temperature", "20degC"},     [FILE_KIND_UNITS] = {"units", "\"E'=MPa\""},
    {"deformation", "tension"},    {"frequency", "10Hz"},
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
    fact_item item;
    unsigned kind;    /* WT_KIND_* of a file with this item; 0: any */
    const char *next; /* subcommand for the file if the item is the first; NULL: by its kind */
} shown_items[] = {{FACT_CURVES, WT_KIND_FORCE, NULL},
                   {FACT_RECORD, WT_KIND_RECORD, "record"},
                   {FACT_SPRING_CONSTANT, 0, NULL},
                   {FACT_SENSITIVITY, 0, NULL},
                   {FACT_ISOTHERMS, WT_KIND_SWEEP, NULL},
                   {FACT_RAMPS, WT_KIND_SWEEP, "ramp"},
                   {FACT_STRAIN_SWEEPS, WT_KIND_SWEEP, "payne"},
                   {FACT_DEFORMATION, 0, NULL},
                   {FACT_SPECTRUM, WT_KIND_SPECTRUM, NULL}};

/* Row of the metadata table. */
typedef struct metadata_row {
    fact_item kind;       /* FACT_ITEM_UNKNOWN for other items */
    wt_quantity quantity; /* of a column */
    const char *item, *value, *unit, *options;
} metadata_row;

static metadata_row read_row(const wt_table *metadata, size_t row)
{
    const double quantity = wt_table_number(metadata, row, FACTS_QUANTITY);
    return (metadata_row){(fact_item)wt_table_number(metadata, row, FACTS_KIND),
                          isnan(quantity) ? WT_Q_NONE : (wt_quantity)quantity,
                          wt_table_text(metadata, row, FACTS_ITEM),
                          wt_table_text(metadata, row, FACTS_VALUE),
                          wt_table_text(metadata, row, FACTS_UNIT),
                          wt_table_text(metadata, row, FACTS_OPTIONS)};
}

/* Adds an item to the description. A second one is the header value of a converted value. */
static void read_shown_item(const metadata_row *row, file_kind *found)
{
    const size_t used = strlen(found->description);
    char shown[160];
    size_t i = 0;
    while (i < COUNT_OF(shown_items) && shown_items[i].item != row->kind)
        i++;
    const uint64_t bit = i < COUNT_OF(shown_items) ? SCHEMA_BIT(row->kind) : 0;
    if (bit == 0 || strcmp(row->value, "0") == 0 || (found->items & bit) != 0)
        return;
    if (found->kind == 0) {
        found->kind = shown_items[i].kind;
        found->next = shown_items[i].next;
    }
    format_metadata_value(row->value, row->unit, shown, sizeof shown);
    snprintf(found->description + used, sizeof found->description - used, "%s%s %s",
             found->items != 0 ? ", " : ": ", row->item, shown);
    found->items |= bit;
}

static void read_tip(const metadata_row *row, file_kind *found)
{
    const char *const comma = strchr(row->item, ','); /* "tip radius, um (not used)" */
    const char *const unit = comma != NULL ? comma + strspn(comma, ", ") : "";
    if (row->kind == FACT_TIP_RADIUS)
        snprintf(found->tip, sizeof found->tip, "sphere:radius=%s%.*s", row->value,
                 (int)strcspn(unit, " "), unit);
}

/* Stores the quantity of a column, and the name of a column without a unit, which needs its own
 * --units. */
static void read_column(const metadata_row *row, file_kind *found)
{
    found->has_x |= row->quantity == WT_Q_POSITION_X;
    found->has_y |= row->quantity == WT_Q_POSITION_Y;
    found->has_force |= row->quantity == WT_Q_FRICTION_FORCE;
    found->has_torque |= row->quantity == WT_Q_TORQUE;
    found->has_load |=
        row->quantity == WT_Q_NORMAL_FORCE || row->quantity == WT_Q_FRICTION_COEFFICIENT;
    const char *const quote = strchr(row->item, '"'); /* column "NAME" */
    const size_t used = strlen(found->unitless), length = quote != NULL ? strlen(quote) : 0;
    if (row->options[0] != '\0' && length > 1 && length + used < sizeof found->unitless)
        snprintf(found->unitless + used, sizeof found->unitless - used, "%.*s\n", (int)length - 2,
                 quote + 1);
}

bool file_kind_is_missing(const file_kind *found, size_t missing)
{
    return found->missing[missing] && (missing != FILE_KIND_UNITS || *found->unitless == '\0');
}

static void read_metadata(const wt_formats *formats, const wt_table *metadata, file_kind *found)
{
    const wt_format_info *format = NULL;
    for (size_t i = 0; i < wt_table_n_rows(metadata); i++) {
        const metadata_row row = read_row(metadata, i);
        if (format == NULL && row.kind == FACT_FORMAT) {
            format = wt_formats_find(formats, row.value);
            snprintf(found->description, sizeof found->description, "%s", row.value);
        }
        found->is_result |= row.kind == FACT_TABLE;
        found->one_row |= row.kind == FACT_PROFILE;
        found->unread |= row.kind == FACT_UNREADABLE;
        if (row.kind == FACT_COLUMN)
            read_column(&row, found);
        else
            for (size_t k = 0; k < FILE_KIND_N_MISSING; k++)
                found->missing[k] |= cmd_names_contain(row.options, file_kind_missing_rows[k].name);
        read_shown_item(&row, found);
        read_tip(&row, found);
    }
    /* no command reads a file whose fault no option mends */
    bool can_mend = *found->unitless != '\0';
    for (size_t i = 0; i < FILE_KIND_N_MISSING; i++)
        can_mend = can_mend || found->missing[i];
    found->nothing = found->unread && found->kind == 0 && !can_mend;
    found->is_result = found->is_result && wt_format_is_own(format);
    /* a file that is not readable yet does not show its kind */
    if (found->kind == 0 && format != NULL && !found->is_result)
        found->kind = format->kinds & (~format->kinds + 1);
    if (format != NULL && found->kind == WT_KIND_FORCE && (format->kinds & WT_KIND_IMAGE) != 0 &&
        (found->items & SCHEMA_BIT(FACT_CURVES)) == 0)
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
