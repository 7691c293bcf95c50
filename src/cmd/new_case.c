/* weartrack new-case: a commented case file from the files that there are.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "cmd/found.h"

/* What is not known stands in the case as these words, which no quantity and no tip is. */
#define FILL_IN "FILL IN"

typedef enum place { BULK, TRACK, GUESSED, DMA, ROUGHNESS, UNUSED, N_PLACES } place;

typedef struct entry {
    char *path;
    place place;
    found_file found;
    char problem[512]; /* why it could not be read, "" if it could */
} entry;

typedef struct new_case {
    const cmd_common *common;
    const wt_formats *formats;
    wt_read_options read;
    entry *entries;
    size_t n;
    bool failed;
} new_case;

/* ---- what the files are ---------------------------------------------------------------------- */

/* Whether the file or the folder it lies in is called so, in small letters or capitals. */
static bool is_called(const char *path, const char *const *words)
{
    for (const char *p = path + strlen(path), *slash = NULL; p > path; p--)
        if (*p == '/' && slash != NULL) {
            path = p + 1;
            break;
        } else if (*p == '/') {
            slash = p;
        }
    for (size_t i = 0; words[i] != NULL; i++)
        if (strcasestr(path, words[i]) != NULL)
            return true;
    return false;
}

static place guess_place(const char *path, const found_file *found)
{
    static const char *const bulk[] = {"bulk",   "unworn",    "virgin", "outside",
                                       "beside", "reference", NULL};
    static const char *const track[] = {"track", "worn", "wear", "scar", "groove", "inside", NULL};
    if (found->kind == WT_KIND_SWEEP)
        return DMA;
    if (found->kind == WT_KIND_SPECTRUM)
        return ROUGHNESS;
    if (found->kind != WT_KIND_FORCE)
        return UNUSED;
    return is_called(path, bulk) ? BULK : is_called(path, track) ? TRACK : GUESSED;
}

static void look(new_case *c, entry *e)
{
    wt_error err = WT_ERROR_INIT;
    wt_input *input = NULL;
    wt_table *facts = NULL;
    wt_status status = wt_input_open(e->path, &input, &err);
    if (status == WT_OK)
        status = wt_describe(c->formats, input, &c->read, NULL, &facts, &err);
    if (status == WT_OK) {
        found_read(c->formats, facts, &e->found);
        e->place = guess_place(e->path, &e->found);
    } else {
        wt_error_file(&err, e->path);
        c->failed = cmd_fail("new-case", &err) != CMD_OK;
        snprintf(e->problem, sizeof e->problem, "%s", err.message);
        e->place = UNUSED;
    }
    wt_table_free(facts);
    wt_input_close(input);
}

/* What a pattern stands for; without a match it is said and the others go on. */
static wt_status add_files(new_case *c, const char *pattern, wt_error *err)
{
    char **paths = NULL;
    size_t n = 0;
    wt_error failure = WT_ERROR_INIT;
    if (wt_glob(NULL, pattern, &paths, &n, &failure) != WT_OK) {
        c->failed = cmd_fail("new-case", &failure) != CMD_OK;
        return WT_OK;
    }
    entry *grown = realloc(c->entries, (c->n + n) * sizeof *grown);
    if (grown == NULL) {
        wt_strings_free(paths, n);
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    }
    c->entries = grown;
    for (size_t i = 0; i < n; i++) {
        grown[c->n] = (entry){.path = paths[i]};
        look(c, &grown[c->n++]);
    }
    free(paths);
    return WT_OK;
}

static size_t count(const new_case *c, place where)
{
    size_t n = 0;
    for (size_t i = 0; i < c->n; i++)
        n += c->entries[i].place == where;
    return n;
}

/* ---- writing --------------------------------------------------------------------------------- */

static void put_text(FILE *out, const char *text)
{
    for (const char *p = text; *p != '\0'; p++) {
        if (*p == '&')
            fputs("&amp;", out);
        else if (*p == '<')
            fputs("&lt;", out);
        else if (*p == '"')
            fputs("&quot;", out);
        else
            putc(*p, out);
    }
}

/* In a comment two hyphens must not follow one another. */
static void put_comment(FILE *out, const char *text)
{
    for (const char *p = text; *p != '\0'; p++)
        if (!(p[0] == '-' && (p > text) && p[-1] == '-'))
            putc(*p, out);
}

/* The path as it holds from the folder of the case. */
static void put_path(FILE *out, const char *output, const char *path)
{
    char *whole = NULL;
    if (output != NULL && strchr(output, '/') != NULL && path[0] != '/')
        whole = realpath(path, NULL);
    put_text(out, whole != NULL ? whole : path);
    free(whole);
}

static void put_files(FILE *out, const new_case *c, place where, const char *element)
{
    const char *indent = where == BULK || where == TRACK ? "      " : "    ";
    const entry *last = NULL; /* equal words stand once */
    for (size_t i = 0; i < c->n; i++) {
        const entry *e = &c->entries[i];
        if (e->place != where && !(where == BULK && e->place == GUESSED))
            continue;
        if (last == NULL || strcmp(last->found.words, e->found.words) != 0 ||
            last->place != e->place) {
            fprintf(out, "%s<!-- ", indent);
            put_comment(out, e->found.words);
            fprintf(out, "%s -->\n",
                    e->place == GUESSED ? "; bulk is a guess: no name says bulk or track" : "");
        }
        last = e;
        fprintf(out, "%s<%s", indent, element);
        for (size_t k = 0; k < FOUND_N_MISSING; k++)
            if (e->found.missing[k])
                fprintf(out, " %s=\"" FILL_IN "\"", found_missing_rows[k].name);
        putc('>', out);
        put_path(out, c->common->output, e->path);
        fprintf(out, "</%s>\n", element);
    }
}

static void put_indentation(FILE *out, const new_case *c, const char *tip)
{
    const size_t n_track = count(c, TRACK), n_bulk = count(c, BULK) + count(c, GUESSED);
    if (n_track + n_bulk == 0) {
        fputs("\n  <!-- no force curves: no section indentation -->\n", out);
        return;
    }
    fputs("\n  <indentation>\n    <!-- sphere:radius=5um, pyramid:half-angle=20deg,radius=20nm ... "
          "-->\n    <tip>",
          out);
    put_text(out, tip != NULL ? tip : FILL_IN);
    fputs("</tip>\n", out);
    if (n_bulk > 0) {
        fputs("    <bulk>\n", out);
        put_files(out, c, BULK, "files");
        fputs("    </bulk>\n", out);
    }
    if (n_track > 0) {
        fputs("    <track>\n", out);
        put_files(out, c, TRACK, "files");
        fputs("    </track>\n", out);
    }
    fputs("  </indentation>\n", out);
}

static void put_material(FILE *out, const new_case *c)
{
    if (count(c, DMA) == 0) {
        fputs("\n  <!-- no DMA sweeps: no section dma -->\n", out);
        return;
    }
    fputs("\n  <dma>\n    <!-- <reference-temperature>20degC</reference-temperature>, else that of "
          "the middle isotherm -->\n",
          out);
    put_files(out, c, DMA, "files");
    fputs("  </dma>\n", out);
}

static void put_roughness(FILE *out, const new_case *c)
{
    if (count(c, ROUGHNESS) != 1) {
        fputs("\n  <!-- Counter surface; for friction:\n  <roughness>\n    <self-affine>\n"
              "      <q0>" FILL_IN ", such as 2e3rad/m</q0>\n"
              "      <q1>" FILL_IN ", such as 2e6rad/m</q1>\n"
              "      <hurst>" FILL_IN ", such as 0.8</hurst>\n"
              "      <c0>" FILL_IN ", such as 2e-17m^4</c0>\n"
              "    </self-affine>\n  </roughness> -->\n",
              out);
        for (size_t i = 0; i < c->n; i++)
            if (c->entries[i].place == ROUGHNESS) {
                fputs("  <!-- one of several spectra: ", out);
                put_comment(out, c->entries[i].path);
                fputs(" -->\n", out);
            }
        return;
    }
    fputs("\n  <roughness>\n    <spectrum>\n", out);
    put_files(out, c, ROUGHNESS, "file");
    fputs("    </spectrum>\n  </roughness>\n", out);
}

static void put_rest(FILE *out, const new_case *c)
{
    fputs("\n  <!-- For friction:\n  <sliding>\n"
          "    <pressure>" FILL_IN ", such as 0.4MPa</pressure>\n"
          "    <velocity>" FILL_IN ", such as 1e-4:10m/s:log:31</velocity>\n"
          "    <temperature>" FILL_IN ", such as 30degC</temperature>\n"
          "    <shear-stress>" FILL_IN ", such as 5MPa; may be left out</shear-stress>\n"
          "  </sliding> -->\n"
          "\n  <!-- For the thickness of the layer, with one of the last two:\n  <layer>\n"
          "    <specific-wear-rate>" FILL_IN ", such as 1e-3mm^3/(N m)</specific-wear-rate>\n"
          "    <critical-energy>" FILL_IN ", such as 2e10J/m^3</critical-energy>\n"
          "    <observed-thickness>" FILL_IN ", such as 3um</observed-thickness>\n"
          "  </layer> -->\n",
          out);
    const bool bulk = count(c, BULK) + count(c, GUESSED) > 0, track = count(c, TRACK) > 0;
    if (bulk && track)
        fprintf(out, "\n  <compare>\n    <track-to-bulk/>\n    <by-rate/>\n%s  </compare>\n",
                count(c, DMA) > 0 ? "    <indentation-to-dma/>\n" : "");
    for (size_t i = 0; i < c->n; i++) {
        const entry *e = &c->entries[i];
        if (e->place != UNUSED)
            continue;
        fputs("  <!-- not used: ", out);
        put_comment(out, e->path);
        fputs(": ", out);
        put_comment(out, e->problem[0] != '\0' ? e->problem : e->found.words);
        fputs(" -->\n", out);
    }
}

static wt_status write_case(const new_case *c, const char *tip, wt_error *err)
{
    cmd_sink sink;
    wt_status status = cmd_sink_open(c->common->output, &sink, err);
    if (status == WT_OK) {
        fputs("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
              "<!-- What stands here as " FILL_IN " is in no file: put the value there, with its "
              "unit. Then:\n     weartrack run with the name of this file. See weartrack-case(5). "
              "-->\n<case version=\"1\">\n  <title>" FILL_IN "</title>\n",
              sink.stream);
        put_indentation(sink.stream, c, tip);
        put_material(sink.stream, c);
        put_roughness(sink.stream, c);
        put_rest(sink.stream, c);
        fputs("</case>\n", sink.stream);
        if (ferror(sink.stream))
            status = wt_fail(err, WT_E_IO, "cannot write: %s", strerror(errno));
    }
    return cmd_sink_close(&sink, status, err);
}

/* ---- the call -------------------------------------------------------------------------------- */

typedef struct own_options {
    const char *tip;
} own_options;

static own_options no_options(void)
{
    return (own_options){NULL};
}

static const wt_param rows[] = {
    {PARAM_TEXT_OF("tip", own_options, tip), .value = "TIP", .unset = "",
     .help = "tip of the cantilever, as that of weartrack indent"},
};
PARAM_LOCAL_TABLE(own_params, own_options, rows, no_options, NO_PARTS)

int cmd_new_case(int argc, char **argv)
{
    static const cmd_usage usage = {
        "new-case", "[OPTION]... FILE...",
        "Writes a commented case file (weartrack-case(5)) for the files (folders and patterns are\n"
        "allowed): force curves as bulk or track, by the names of their folders; DMA sweeps; a\n"
        "power spectrum. What no file says stands there as " FILL_IN ".",
        "output formats files-from",
        "Exit status 1 if a file was not understood; the case names it in a comment."};
    cmd_common common = cmd_common_defaults();
    own_options own = no_options();
    cmd_part part = {own_params(), &own, NULL, 0};
    int first = 0, status = CMD_OK;
    wt_error err = WT_ERROR_INIT;
    wt_formats *formats = NULL;
    if (!cmd_parse(&usage, &part, 1, &common, argc, argv, &first, &status))
        return status;
    if (common.n_files == 0)
        return cmd_usage_error("new-case", "no file given");
    wt_status made = wt_formats_new(common.formats, &formats, NULL, &err);
    new_case c = {.common = &common, .formats = formats, .read = wt_read_defaults()};
    for (size_t i = 0; i < common.n_files && made == WT_OK; i++)
        made = add_files(&c, common.files[i], &err);
    if (made == WT_OK)
        made = c.n > 0 ? write_case(&c, own.tip, &err)
                       : wt_fail(&err, WT_E_EMPTY, "no file: no case is written");
    status = made != WT_OK ? cmd_fail("new-case", &err) : c.failed ? CMD_FAILED : CMD_OK;
    if (made == WT_OK && common.output != NULL && !common.quiet)
        cmd_say("next: fill in what is missing, then weartrack run %s\n", common.output);
    for (size_t i = 0; i < c.n; i++)
        free(c.entries[i].path);
    free(c.entries);
    wt_formats_free(formats);
    return status;
}
