/* weartrack info: shows the kind and the metadata of a file. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#include <string.h>

#include "cmd/file_kind.h"
#include "core/base/array.h"
#include "core/table/registry.h"

/* What a terminal shows: rows of the only file, or files, one line each. */
enum { ROWS_SHOWN = 12, FILES_SHOWN = 14 };

/* Prints the name of one of several files with its format. */
static void print_format(const char *name, const wt_table *metadata)
{
    const char *format = "";
    for (size_t row = 0; row < wt_table_n_rows(metadata) && *format == '\0'; row++)
        if (strcmp(wt_table_text(metadata, row, FACTS_ITEM), "format") == 0)
            format = wt_table_text(metadata, row, FACTS_VALUE);
    printf("%s  %s\n", name, format);
}

/* Prints the first `limit` rows. If there are more, each takes one line. */
static void print_metadata(const char *name, const wt_table *metadata, size_t limit)
{
    enum { MAX_LABEL = 42, DOTS = 3 };
    size_t n_shown = 0;
    const bool brief = limit < wt_table_n_rows(metadata);
    size_t width = 0;
    for (size_t row = 0; row < wt_table_n_rows(metadata); row++) {
        const char *label = wt_table_text(metadata, row, FACTS_ITEM);
        const size_t w = cmd_text_width(label, strlen(label));
        width = w > width && w <= MAX_LABEL ? w : width;
    }
    printf("%s\n", name);
    for (size_t row = 0; row < wt_table_n_rows(metadata); row++) {
        const char *label = wt_table_text(metadata, row, FACTS_ITEM);
        const char *s = wt_table_text(metadata, row, FACTS_SOURCE);
        const char *v = wt_table_text(metadata, row, FACTS_VALUE);
        if (strcmp(label, "file") == 0 && strcmp(v, name) == 0)
            continue; /* the heading has it */
        if (n_shown++ >= limit)
            continue;
        char shown[1024], line[2048];
        format_metadata_value(v, wt_table_text(metadata, row, FACTS_UNIT), shown, sizeof shown);
        snprintf(line, sizeof line, *s != '\0' ? "%s  (%s)" : "%s%s", shown, s);
        const size_t w = cmd_text_width(label, strlen(label));
        printf("  %s%*s  ", label, w < width ? (int)(width - w) : 0, "");
        const size_t column = 4 + (w > width ? w : width);
        const size_t length = strlen(line);
        if (brief && column + cmd_text_width(line, length) > CMD_SCREEN_WIDTH) {
            const size_t room =
                column + DOTS < CMD_SCREEN_WIDTH ? CMD_SCREEN_WIDTH - DOTS - column : 0;
            const size_t n = cmd_text_fit(line, length, room);
            snprintf(line + n, sizeof line - n, "...");
        }
        cmd_wrap(stdout, column, width + 4, line);
    }
    if (n_shown > limit)
        printf("  and %zu more rows: --verbose\n", n_shown - limit);
}

static void print_file(const cmd_session *s, size_t i, const wt_table *metadata)
{
    const char *const path = s->files[i];
    if (!cmd_shows_first_lines(s))
        print_metadata(path, metadata, SIZE_MAX);
    else if (s->n_files == 1)
        print_metadata(path, metadata, ROWS_SHOWN);
    else if (i < FILES_SHOWN)
        print_format(path, metadata);
}

/* Prints one file; true if its format is known. */
static bool print_file_info(cmd_session *s, size_t i, const wt_read_options *options,
                            file_kind *found)
{
    wt_table *metadata = NULL;
    wt_log *log = wt_log_new();
    const wt_status status = file_kind_detect(s, s->files[i], options, log, &metadata, found);
    if (status == WT_OK)
        print_file(s, i, metadata);
    /* Notes are shown, too, as the user wants all remarks on the file. */
    cmd_print_log(s, log, true);
    if (status != WT_OK)
        cmd_report_failure(s);
    wt_table_free(metadata);
    wt_log_free(log);
    return status == WT_OK;
}

/* Prints the options that the user must supply. Missing units of columns are not guessed. */
static void print_missing_options(const file_kind *found)
{
    const char *name = found->unitless;
    for (size_t k = 0; k < FILE_KIND_N_MISSING; k++)
        if (file_kind_is_missing(found, k))
            printf(" --%s %s", file_kind_missing_rows[k].name, file_kind_missing_rows[k].example);
    if (found->has_torque)
        fputs(" --track-radius 10mm", stdout);
    for (size_t n = 0; *name != '\0'; name += n + 1) {
        char given[sizeof found->unitless + sizeof "=UNIT"];
        n = strcspn(name, "\n");
        snprintf(given, sizeof given, "%.*s=UNIT", (int)n, name);
        fputs(" --units", stdout);
        cmd_print_argument(stdout, given);
    }
}

/* True if `word` is an option of reading that the suggested subcommand takes as well. */
static bool is_taken_by(const char *subcommand, const char *word)
{
#define OF_SWEEPS                                                                                  \
    " columns conditioning deformation format formats frequency sample sample-by sheet units "
    static const struct {
        const char *subcommand, *options; /* names between blanks */
    } taken[] = {
        {"convert", OF_SWEEPS " height-unit pixel-size sensitivity spectrum-convention "
                              "spring-constant strain temperature temperature-in-name "},
        {"indent --tip",
         " columns conditioning format formats sensitivity sheet spring-constant units "},
        {"master", OF_SWEEPS " strain temperature temperature-in-name "},
        {"new-case", " formats "},
        {"psd", " columns conditioning format formats height-unit pixel-size sheet units "},
        {"payne", OF_SWEEPS " temperature temperature-in-name "},
        {"ramp", OF_SWEEPS " strain temperature-in-name "},
        {"record", " columns conditioning format formats sheet units "},
    };
#undef OF_SWEEPS
    char name[64];
    snprintf(name, sizeof name, " %.*s ", (int)strcspn(word, "="), word);
    for (size_t i = 0; i < COUNT_OF(taken); i++)
        if (strcmp(subcommand, taken[i].subcommand) == 0)
            return strstr(taken[i].options, name) != NULL;
    return false;
}

/* Prints the options without which the suggested subcommand would not read what this call reads. */
static void print_given_options(int argc, char **argv, const char *subcommand)
{
    for (int i = 1; i < argc; i++) {
        if (strncmp(argv[i], "--", 2) != 0 || !is_taken_by(subcommand, argv[i] + 2))
            continue;
        cmd_print_argument(stdout, argv[i]);
        if (strchr(argv[i], '=') == NULL && i + 1 < argc)
            cmd_print_argument(stdout, argv[++i]);
    }
}

/* Prints a suggestion for the next command, for the only file or for all. */
static void print_next_command(const cmd_session *s, int argc, char **argv, const file_kind *found)
{
    const char *const *files = s->files;
    if (found->nothing)
        return;
    if (s->n_files > 1) {
        fputs("\nnext: weartrack new-case", stdout);
        print_given_options(argc, argv, "new-case");
        for (size_t i = 0; i < s->n_files; i++)
            cmd_print_argument(stdout, files[i]);
        fputs(" -o case.xml\n", stdout);
        return;
    }
    const bool is_map = found->kind == WT_KIND_IMAGE && !found->one_row &&
                        (found->has_y || !found->has_x); /* a profile may be across a track */
    const char *const next = found->is_result               ? "table --list"
                             : found->kind == WT_KIND_FORCE ? "indent --tip"
                             : found->next != NULL          ? found->next
                             : found->kind == WT_KIND_SWEEP ? "master"
                             : is_map                       ? "psd"
                                                            : "convert";
    printf("\nnext: weartrack %s", next);
    if (!found->is_result && found->kind == WT_KIND_FORCE)
        cmd_print_argument(stdout, *found->tip != '\0' ? found->tip
                                                       : "pyramid:half-angle=35deg,radius=20nm");
    print_given_options(argc, argv, next);
    print_missing_options(found);
    cmd_print_argument(stdout, files[0]);
    char *output = found->is_result
                       ? NULL
                       : cmd_default_name(files[0], cmd_is_hdf5_path(files[0])
                                                        ? "-result.h5" /* not the input itself */
                                                        : ".h5");
    if (output != NULL) {
        fputs(" -o", stdout);
        cmd_print_argument(stdout, output);
    }
    free(output);
    putchar('\n');
    if (*found->unitless != '\0')
        puts("      with, for each UNIT, the one that the instrument exports, such as mm");
}

int cmd_info(int argc, char **argv)
{
    static const cmd_usage usage = {
        .name = "info",
        .arguments = "[OPTION]... FILE...",
        .description = "Reports for each file its format, segments, channels and calibration, and "
                       "what is missing or unexpected. - is standard input.",
        .common = "formats columns files-from",
        .n_files = CMD_ONE_OR_MORE};
    wt_read_options read = wt_read_defaults();
    cmd_option_group part = {wt_read_params(), &read, NULL, 0};
    cmd_session s = cmd_session_defaults();
    size_t n_known = 0, n_found = 0;
    file_kind found;
    if (!cmd_parse(&s, &usage, &part, 1, argc, argv) || !cmd_begin_reading(&s, read.format))
        return cmd_session_free(&s);
    for (size_t i = 0; i < s.n_files; i++) {
        if (i > 0 && !cmd_shows_first_lines(&s))
            putchar('\n');
        n_known += print_file_info(&s, i, &read, &found);
        n_found += found.description[0] != '\0';
    }
    if (s.n_files > FILES_SHOWN && cmd_shows_first_lines(&s))
        printf("and %zu more files: --verbose\n", s.n_files - FILES_SHOWN);
    if (n_known == 0)
        s.status = CMD_FAILED;
    if (n_found == s.n_files)
        print_next_command(&s, argc, argv, &found);
    return cmd_session_free(&s);
}
