/* weartrack info: what a file is. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "cmd/found.h"

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
        found_value(v, wt_table_text(facts, row, (size_t)unit), shown, sizeof shown);
        snprintf(line, sizeof line, *s != '\0' ? "%s  (%s)" : "%s%s", shown, s);
        const size_t w = cmd_text_width(label, strlen(label));
        printf("  %s%*s  ", label, w < width ? (int)(width - w) : 0, "");
        cmd_wrap(stdout, 4 + (w > width ? w : width), width + 4, line);
    }
}

static int info_one(const wt_formats *formats, const char *path, const wt_read_options *options,
                    const cmd_common *common, found_file *found)
{
    wt_error err = WT_ERROR_INIT;
    wt_input *input = NULL;
    wt_table *facts = NULL;
    wt_parselog *log = wt_parselog_new();
    *found = (found_file){0};
    wt_status status = wt_input_open(path, &input, &err);
    if (status == WT_OK)
        status = wt_describe(formats, input, options, log, &facts, &err);
    if (status == WT_OK) {
        print_facts(path, facts);
        found_read(formats, facts, found);
    }
    wt_error_file(&err, path);
    /* Somebody who asks what a file is wants to see everything that is odd about it. */
    const int said = cmd_say_log("info", common, log, true);
    wt_table_free(facts);
    wt_input_close(input);
    wt_parselog_free(log);
    return status != WT_OK ? cmd_fail("info", &err) : said;
}

/* As a shell takes it for one word. */
static void print_word(const char *word)
{
    static const char plain[] =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+./=,:@";
    const bool quoted = word[strspn(word, plain)] != '\0';
    putchar(' ');
    if (!quoted) {
        fputs(word, stdout);
        return;
    }
    putchar('\'');
    for (const char *p = word; *p != '\0'; p++)
        if (*p == '\'')
            fputs("'\\''", stdout);
        else
            putchar((unsigned char)*p < ' ' ? '?' : *p);
    putchar('\'');
}

/* "dir/bulk.jpk-force" -> " -o bulk.h5" */
static void print_output(const char *path)
{
    const char *base = wt_path_base(path);
    const char *dot = strrchr(base, '.');
    char name[256];
    snprintf(name, sizeof name, "%.*s.h5",
             dot != NULL && dot != base ? (int)(dot - base) : (int)strlen(base), base);
    fputs(" -o", stdout);
    print_word(name);
}

/* The command to type next for the only file, or for all of them. */
static void print_next(const char *const *files, size_t n, const found_file *found)
{
    if (n > 1) {
        fputs("\nnext: weartrack new-case", stdout);
        for (size_t i = 0; i < n; i++)
            print_word(files[i]);
        fputs(" -o case.xml\n", stdout);
        return;
    }
    if (found->is_result)
        fputs("\nnext: weartrack table --list", stdout);
    else if (found->kind == WT_KIND_FORCE)
        fputs("\nnext: weartrack indent --tip pyramid:half-angle=35deg,radius=20nm", stdout);
    else if (found->kind == WT_KIND_SWEEP)
        fputs("\nnext: weartrack master", stdout);
    else
        fputs("\nnext: weartrack convert", stdout);
    for (size_t k = 0; k < FOUND_N_MISSING; k++)
        if (found->missing[k])
            printf(" --%s %s", found_missing_rows[k].name, found_missing_rows[k].example);
    print_word(files[0]);
    if (!found->is_result)
        print_output(files[0]);
    putchar('\n');
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
    size_t n_found = 0;
    found_file found;
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
        if (info_one(formats, common.files[i], &read, &common, &found) != CMD_OK)
            status = CMD_FAILED;
        n_found += found.words[0] != '\0';
    }
    if (n_found == common.n_files)
        print_next(common.files, common.n_files, &found);
done:
    wt_formats_free(formats);
    cmd_parts_clear(&part, 1);
    return status;
}
