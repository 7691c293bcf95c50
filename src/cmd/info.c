/* weartrack info: what a file is. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "cmd/cmd.h"

/* Numbers as people read them: few digits, the unit with its prefix. Anything else as it is. */
static void format_value(const char *value, const char *unit, char *out, size_t size)
{
    enum { DIGITS = 6 };
    static const char *const si[] = {"m", "m/s", "m/V", "N", "N/m", "Pa", "s", "V", "rad/s"};
    double number = 0;
    const bool is_number = wt_number_parse(value, strlen(value), '.', &number);
    const bool has_unit = *unit != '\0' && strcmp(unit, "1") != 0;
    for (size_t i = 0; is_number && i < sizeof si / sizeof si[0]; i++)
        if (strcmp(unit, si[i]) == 0) {
            char digits[128];
            wt_format_si(number, unit, DIGITS, digits, sizeof digits);
            /* without the zeros at the end: 61.0000 mN/m is 61 mN/m */
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

static void print_facts(const char *name, const wt_table *facts)
{
    enum { MAX_LABEL = 42 };
    const long item = wt_table_find(facts, "item"), value = wt_table_find(facts, "value");
    const long unit = wt_table_find(facts, "unit"), source = wt_table_find(facts, "source");
    size_t width = 0;
    for (size_t row = 0; row < wt_table_n_rows(facts); row++) {
        const char *label = wt_table_text(facts, row, (size_t)item);
        const size_t w = cmd_text_width(label, strlen(label));
        width = w > width && w <= MAX_LABEL ? w : width;
    }
    printf("%s\n", name);
    for (size_t row = 0; row < wt_table_n_rows(facts); row++) {
        const char *label = wt_table_text(facts, row, (size_t)item);
        const char *s = source >= 0 ? wt_table_text(facts, row, (size_t)source) : "";
        const char *v = wt_table_text(facts, row, (size_t)value);
        if (strcmp(label, "file") == 0 && strcmp(v, name) == 0)
            continue; /* the heading says it */
        char shown[1024], line[2048];
        format_value(v, wt_table_text(facts, row, (size_t)unit), shown, sizeof shown);
        snprintf(line, sizeof line, *s != '\0' ? "%s  (%s)" : "%s%s", shown, s);
        const size_t w = cmd_text_width(label, strlen(label));
        printf("  %s%*s  ", label, w < width ? (int)(width - w) : 0, "");
        cmd_wrap(stdout, 4 + (w > width ? w : width), width + 4, line);
    }
}

static int info_one(const wt_formats *formats, const char *path, const wt_read_options *options,
                    const cmd_common *common)
{
    wt_error err = WT_ERROR_INIT;
    wt_input *input = NULL;
    wt_table *facts = NULL;
    wt_parselog *log = wt_parselog_new();
    wt_status status = wt_input_open(path, &input, &err);
    if (status == WT_OK)
        status = wt_describe(formats, input, options, log, &facts, &err);
    if (status == WT_OK)
        print_facts(path, facts);
    wt_error_file(&err, path);
    /* Somebody who asks what a file is wants to see everything that is odd about it. */
    const int said = cmd_say_log("info", common, log, true);
    wt_table_free(facts);
    wt_input_close(input);
    wt_parselog_free(log);
    return status != WT_OK ? cmd_fail("info", &err) : said;
}

int cmd_info(int argc, char **argv)
{
    static const cmd_usage usage = {"info", "[OPTION]... FILE...",
                                    "Says what each file is and who recognised it, its segments, "
                                    "channels and calibration, and\n"
                                    "what is missing or odd. - is standard input.",
                                    "formats files-from", NULL};
    cmd_common common = cmd_common_defaults();
    wt_read_options read = wt_read_defaults();
    cmd_part part = {wt_read_params(), &read, NULL, 0};
    int first = 0, status = CMD_OK;
    wt_formats *formats = NULL;
    if (!cmd_parse(&usage, &part, 1, &common, argc, argv, &first, &status))
        goto done;
    if (common.n_files == 0) {
        status = cmd_usage_error("info", "no file given");
        goto done;
    }
    wt_error err = WT_ERROR_INIT;
    if (wt_formats_new(common.formats, &formats, NULL, &err) != WT_OK) {
        status = cmd_fail("info", &err);
        goto done;
    }
    status = cmd_check_format("info", read.format, formats);
    if (status != CMD_OK)
        goto done;
    for (size_t i = 0; i < common.n_files; i++) {
        if (i > 0)
            putchar('\n');
        if (info_one(formats, common.files[i], &read, &common) != CMD_OK)
            status = CMD_FAILED;
    }
done:
    wt_formats_free(formats);
    cmd_parts_clear(&part, 1);
    return status;
}
