/* weartrack info: what a file is. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "cmd/readopts.h"

/* Length in characters, not bytes: labels hold degree and micro signs. */
static size_t text_width(const char *text)
{
    size_t n = 0;
    for (; *text != '\0'; text++)
        n += ((unsigned char)*text & 0xC0) != 0x80;
    return n;
}

static void print_facts(const char *name, const wt_table *facts)
{
    const long item = wt_table_find(facts, "item"), value = wt_table_find(facts, "value");
    const long unit = wt_table_find(facts, "unit"), source = wt_table_find(facts, "source");
    size_t width = 0;
    for (size_t row = 0; row < wt_table_n_rows(facts); row++) {
        const size_t w = text_width(wt_table_text(facts, row, (size_t)item));
        width = w > width ? w : width;
    }
    printf("%s\n", name);
    for (size_t row = 0; row < wt_table_n_rows(facts); row++) {
        const char *label = wt_table_text(facts, row, (size_t)item);
        const char *u = wt_table_text(facts, row, (size_t)unit);
        const char *s = source >= 0 ? wt_table_text(facts, row, (size_t)source) : "";
        const char *v = wt_table_text(facts, row, (size_t)value);
        const size_t n_value = strlen(v), n_unit = strlen(u);
        /* a text that tells a conversion ends in the unit already */
        const bool has_unit = n_value > n_unit && strcmp(v + n_value - n_unit, u) == 0;
        printf("  %s%*s  %s", label, (int)(width - text_width(label)), "", v);
        if (*u != '\0' && strcmp(u, "1") != 0 && !has_unit)
            printf(" %s", u);
        if (*s != '\0')
            printf("  (%s)", s);
        putchar('\n');
    }
}

static wt_status info_one(const wt_formats *formats, const char *path,
                          const wt_read_options *options, bool quiet, wt_error *err)
{
    wt_input *input = NULL;
    wt_table *facts = NULL;
    wt_parselog *log = wt_parselog_new();
    wt_status status = wt_input_open(path, &input, err);
    if (status == WT_OK)
        status = wt_describe(formats, input, options, log, &facts, err);
    if (status == WT_OK)
        print_facts(path, facts);
    wt_error_file(err, path);
    /* Somebody who asks what a file is wants to see everything that is odd about it. */
    cmd_print_log("info", log, true, quiet);
    wt_table_free(facts);
    wt_input_close(input);
    wt_parselog_free(log);
    return status;
}

int cmd_info(int argc, char **argv)
{
    cmd_common common = CMD_COMMON_DEFAULTS;
    cmd_read_values values;
    cmd_read_values_init(&values);
    cmd_option options[8];
    size_t n = cmd_read_force_options(&values, options);
    n += cmd_read_dma_options(&values, options + n);
    n += cmd_read_units_option(&values, options + n);
    const cmd_usage usage = {"info", "[OPTION]... FILE...",
                             "Says what each file is and who recognised it, its segments, channels "
                             "and calibration, and\n"
                             "what is missing or odd. - is standard input.",
                             CMD_OPT_FORMAT | CMD_OPT_FORMATS, NULL};
    int first = 0, status = CMD_OK;
    wt_formats *formats = NULL;
    if (!cmd_parse(&usage, options, n, &common, argc, argv, &first, &status))
        goto done;
    if (first == argc) {
        status = cmd_usage_error("info", "no file given");
        goto done;
    }
    wt_error err = WT_ERROR_INIT;
    if (wt_formats_new(common.formats, &formats, NULL, &err) != WT_OK) {
        status = cmd_fail("info", &err);
        goto done;
    }
    const wt_read_options read_options = cmd_read_make(&values, &common);
    for (int i = first; i < argc; i++) {
        err = (wt_error)WT_ERROR_INIT;
        if (i > first)
            putchar('\n');
        if (info_one(formats, argv[i], &read_options, common.quiet, &err) != WT_OK)
            status = cmd_fail("info", &err);
    }
done:
    wt_formats_free(formats);
    cmd_read_values_free(&values);
    return status;
}
