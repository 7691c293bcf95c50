/* weartrack new-case: a commented case file from the files that there are.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <dirent.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/utf8.h"
#include "cmd/found.h"

/* What is not known stands in the case as these words, which no quantity and no tip is. */
#define FILL_IN "FILL IN"

typedef enum place { BULK, TRACK, DMA, ROUGHNESS, MAPS, UNUSED } place;

typedef struct entry {
    char *path, *in_case; /* as given, and as it holds from the folder of the case */
    place place;
    const char *word; /* of its path that says bulk or track; NULL: none does */
    bool of_folder;   /* that word is in the name of a folder */
    found_file found; /* its words are the problem of a file that could not be read */
} entry;

typedef struct new_case {
    cmd_session *s;
    const char *tip; /* of the cantilever; NULL if not known */
    entry *entries;
    size_t n;
} new_case;

/* ---- names in XML ---------------------------------------------------------------------------- */

/* Well-formed UTF-8, but no character of XML: U+FFFE and U+FFFF. */
static bool is_no_character(const char *text)
{
    return strncmp(text, "\xEF\xBF\xBE", 3) == 0 || strncmp(text, "\xEF\xBF\xBF", 3) == 0;
}

/* What keeps a name from being read back from a case as it is; NULL: nothing. */
static const char *find_unfit(const char *name)
{
    const size_t n = strlen(name);
    if (utf8_check(name, n) < n)
        return "bytes that are not UTF-8";
    for (const char *p = name; *p != '\0'; p++) {
        if ((unsigned char)*p < ' ' || *p == 0x7f)
            return "a control character";
        if (is_no_character(p))
            return "a character that XML does not have";
    }
    return n > 0 && (name[0] == ' ' || name[n - 1] == ' ') ? "a blank at its beginning or end"
                                                           : NULL;
}

/* The path as it holds from the folder of the case; NULL: no memory. */
static char *path_in_case(const new_case *c, const char *path)
{
    const char *const output = c->s->common.output;
    char *whole = NULL;
    if (output != NULL && strchr(output, '/') != NULL && path[0] != '/')
        whole = realpath(path, NULL);
    return whole != NULL ? whole : strdup(path);
}

static void put_text(FILE *out, const char *text)
{
    static const char marks[] = "&<>\"";
    static const char *const names[] = {"&amp;", "&lt;", "&gt;", "&quot;"};
    for (const char *p = text; *p != '\0'; p++) {
        const char *const mark = strchr(marks, *p);
        if (mark != NULL)
            fputs(names[mark - marks], out);
        else
            putc(*p, out);
    }
}

/* In a comment two hyphens must not follow one another. */
static void put_comment(FILE *out, const char *text)
{
    const size_t length = strlen(text);
    for (size_t i = 0, n; i<length; i += n> 0 ? n : 1) {
        n = utf8_character(text + i, length - i);
        if (n == 0 || (unsigned char)text[i] < ' ' || is_no_character(text + i))
            putc('?', out);
        else if (!(text[i] == '-' && i > 0 && text[i - 1] == '-'))
            fwrite(text + i, 1, n, out);
    }
}

/* ---- what the files are ---------------------------------------------------------------------- */

/* Which of the words is in the name, in small letters or capitals; NULL: none. */
static const char *find_word(const char *name, size_t length, const char *const *words)
{
    for (size_t i = 0; words[i] != NULL; i++)
        for (size_t k = 0, n = strlen(words[i]); k + n <= length; k++)
            if (strncasecmp(name + k, words[i], n) == 0)
                return words[i];
    return NULL;
}

enum { MOST_WORDS = 7 };
typedef const char *const word_list[MOST_WORDS];

/* By the name of the file, else by that of its folder, else by those of the folders above, as far
 * as they tell the files apart: those behind the first `common` characters. */
static bool find_group_by(entry *e, size_t common, word_list words[])
{
    const char *const path = e->path, *end = path + strlen(path);
    for (int above = 0; end > path && (above < 2 || end > path + common); above++) {
        const char *slash = memrchr(path, '/', (size_t)(end - path));
        const char *name = slash != NULL ? slash + 1 : path;
        for (place where = BULK; where <= TRACK && e->word == NULL; where++) {
            e->word = find_word(name, (size_t)(end - name), words[where]);
            e->place = e->word != NULL ? where : BULK;
        }
        e->of_folder = above > 0;
        if (e->word != NULL)
            return true;
        end = slash != NULL ? slash : path;
    }
    return false;
}

/* A reference may be one of anything, of the track or of the lever: it tells where nothing else
 * does. */
static void find_group(entry *e, size_t common)
{
    static word_list words[] = {
        [BULK] = {"bulk", "unworn", "virgin", "outside", "beside", NULL},
        [TRACK] = {"track", "worn", "wear", "scar", "groove", "inside", NULL}};
    static word_list weak[] = {[BULK] = {"reference", NULL}, [TRACK] = {NULL}};
    if (!find_group_by(e, common, words))
        (void)find_group_by(e, common, weak);
}

/* What the names of force curves say of them; says where they say nothing. */
static void guess_groups(new_case *c)
{
    const entry *first = NULL;
    size_t common = 0, n = 0, n_guessed = 0;
    for (size_t i = 0; i < c->n; i++) {
        const entry *e = &c->entries[i];
        if (e->place != BULK)
            continue;
        size_t same = 0;
        while (first != NULL && e->path[same] != '\0' && e->path[same] == first->path[same])
            same++;
        common = first == NULL ? strlen(e->path) : same < common ? same : common;
        first = first != NULL ? first : e;
    }
    for (size_t i = 0; i < c->n; i++)
        if (c->entries[i].place == BULK) {
            find_group(&c->entries[i], common);
            n_guessed += c->entries[i].word == NULL;
            n++;
        }
    if (n_guessed > 0)
        wt_parselog_add(c->s->log, WT_WARNING, NULL, NULL,
                        "%zu of %zu files of force curves stand in <bulk> by a guess: no name of "
                        "theirs says bulk or track",
                        n_guessed, n);
}

/* Force curves are bulk until their names have been looked at. */
static place place_of(const found_file *found)
{
    return found->kind == WT_KIND_SWEEP      ? DMA
           : found->kind == WT_KIND_SPECTRUM ? ROUGHNESS
           : found->kind == WT_KIND_FORCE    ? BULK
           : found->kind == WT_KIND_IMAGE    ? MAPS
                                             : UNUSED;
}

static size_t count_entries(const new_case *c, place where)
{
    size_t n = 0;
    for (size_t i = 0; i < c->n; i++)
        n += c->entries[i].place == where;
    return n;
}

/* Height maps are of the counter surface, unless a name says that they are of a spot or there is a
 * spectrum of it. */
static void guess_maps(new_case *c)
{
    static const char *const surface[] = {"road",     "counter",   "asphalt", "concrete",
                                          "pavement", "substrate", "disc",    NULL};
    const bool spectrum = count_entries(c, ROUGHNESS) > 0;
    size_t n_guessed = 0;
    for (size_t i = 0; i < c->n; i++) {
        entry *e = &c->entries[i], of_spot = {.path = e->path};
        if (e->place != MAPS)
            continue;
        const char *slash = strrchr(e->path, '/'), *name = slash != NULL ? slash + 1 : e->path;
        const bool said = find_word(name, strlen(name), surface) != NULL;
        find_group(&of_spot, strlen(e->path));
        if (spectrum || (!said && of_spot.word != NULL))
            e->place = UNUSED;
        else
            n_guessed += said ? 0 : 1;
    }
    if (n_guessed > 0)
        wt_parselog_add(c->s->log, WT_WARNING, NULL, NULL,
                        "%zu height map%s in <roughness> by a guess: take out what is no map of "
                        "the counter surface, as images of spots",
                        n_guessed, n_guessed == 1 ? " stands" : "s stand");
}

/* Whether its name can stand in a case, where it must be read back as it is. */
static wt_status check_name(new_case *c, entry *e)
{
    wt_error *const err = &c->s->err;
    e->in_case = path_in_case(c, e->path);
    const char *const unfit = e->in_case != NULL ? find_unfit(e->in_case) : NULL;
    if (e->in_case == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    if (unfit == NULL)
        return WT_OK;
    (void)wt_fail(err, WT_E_ARG, "the name cannot stand in a case file: it has %s", unfit);
    wt_error_file(err, e->path);
    wt_error_advice(err, "give the file, or its folder, another name");
    return WT_E_ARG;
}

static void look_at_entry(new_case *c, entry *e)
{
    const wt_read_options options = wt_read_defaults();
    wt_table *facts = NULL;
    if (check_name(c, e) == WT_OK &&
        found_look(c->s, e->path, &options, NULL, &facts, &e->found) == WT_OK) {
        e->place = place_of(&e->found);
    } else {
        cmd_fail_one(c->s);
        snprintf(e->found.words, sizeof e->found.words, "%s", c->s->err.message);
        e->place = UNUSED;
    }
    wt_table_free(facts);
}

/* What a pattern stands for. */
static wt_status add_files(new_case *c, const char *pattern)
{
    char **paths = NULL;
    size_t n = 0;
    const wt_status status = wt_glob(NULL, pattern, &paths, &n, &c->s->err);
    if (status != WT_OK)
        return status;
    entry *grown = realloc(c->entries, (c->n + n) * sizeof *grown);
    if (grown == NULL) {
        wt_strings_free(paths, n);
        return wt_fail(&c->s->err, WT_E_MEMORY, "out of memory");
    }
    c->entries = grown;
    for (size_t i = 0; i < n; i++) {
        grown[c->n] = (entry){.path = paths[i]};
        look_at_entry(c, &grown[c->n++]);
    }
    free(paths);
    return WT_OK;
}

/* Files that are not hidden, and folders, which come in the order of their names. */
static int is_shown(const struct dirent *item)
{
    return item->d_name[0] != '.';
}

/* Of a failure, which is no reason to leave out the others. */
static wt_status say_and_go_on(new_case *c, wt_status status)
{
    if (status == WT_OK || status == WT_E_MEMORY)
        return status;
    cmd_fail_one(c->s);
    return WT_OK;
}

/* Files of a folder and of the folders in it; links to folders are not followed, which may lead
 * back up. */
static wt_status add_folder(new_case *c, const char *folder)
{
    struct dirent **items = NULL;
    struct stat info;
    wt_status status = add_files(c, folder);
    status = status == WT_E_NOT_FOUND ? WT_OK : status; /* folders only */
    const int n = status == WT_OK ? scandir(folder, &items, is_shown, alphasort) : 0;
    if (n < 0) {
        status = wt_fail(&c->s->err, WT_E_IO, "cannot read the folder: %s", strerror(errno));
        wt_error_file(&c->s->err, folder);
    }
    for (int i = 0; i < n; i++) {
        char *inner = status == WT_OK ? wt_path_join(folder, items[i]->d_name) : NULL;
        if (status == WT_OK && inner == NULL)
            status = wt_fail(&c->s->err, WT_E_MEMORY, "out of memory");
        else if (status == WT_OK && lstat(inner, &info) == 0 && S_ISDIR(info.st_mode))
            status = say_and_go_on(c, add_folder(c, inner));
        free(inner);
        free(items[i]);
    }
    free(items);
    return status;
}

/* What one argument stands for; without a file it is said and the others go on. */
static wt_status add_argument(new_case *c, const char *pattern)
{
    struct stat info;
    const size_t before = c->n;
    wt_status status = stat(pattern, &info) == 0 && S_ISDIR(info.st_mode) ? add_folder(c, pattern)
                                                                          : add_files(c, pattern);
    if (status == WT_OK && c->n == before) {
        status = wt_fail(&c->s->err, WT_E_NOT_FOUND, "no file found in the folder");
        wt_error_file(&c->s->err, pattern);
    }
    return say_and_go_on(c, status);
}

/* ---- writing --------------------------------------------------------------------------------- */

/* Why a file of force curves stands where it stands. */
static void put_reason(FILE *out, const entry *e)
{
    if (e->place > TRACK)
        return;
    if (e->word == NULL)
        fputs("; bulk is a guess: no name says bulk or track", out);
    else
        fprintf(out, "; %s by \"%s\" in the name of the %s", e->place == BULK ? "bulk" : "track",
                e->word, e->of_folder ? "folder" : "file");
}

static void put_files(FILE *out, const new_case *c, place where, const char *element)
{
    const char *indent = where == BULK || where == TRACK ? "      " : "    ";
    const entry *last = NULL; /* equal words stand once */
    for (size_t i = 0; i < c->n; i++) {
        const entry *e = &c->entries[i];
        if (e->place != where)
            continue;
        if (last == NULL || strcmp(last->found.words, e->found.words) != 0 ||
            last->word != e->word || last->of_folder != e->of_folder) {
            fprintf(out, "%s<!-- ", indent);
            put_comment(out, e->found.words);
            put_reason(out, e);
            fputs(" -->\n", out);
        }
        last = e;
        fprintf(out, "%s<%s", indent, element);
        for (size_t k = 0; k < FOUND_N_MISSING; k++)
            if (e->found.missing[k])
                fprintf(out, " %s=\"" FILL_IN "\"", found_missing_rows[k].name);
        putc('>', out);
        put_text(out, e->in_case);
        fprintf(out, "</%s>\n", element);
    }
}

/* The files of a place between two lines; false if there are none. */
static bool put_section(FILE *out, const new_case *c, place where, const char *begin,
                        const char *element, const char *end)
{
    if (count_entries(c, where) == 0)
        return false;
    fputs(begin, out);
    put_files(out, c, where, element);
    fputs(end, out);
    return true;
}

static void put_indentation(FILE *out, const new_case *c)
{
    if (count_entries(c, TRACK) + count_entries(c, BULK) == 0) {
        fputs("\n  <!-- no force curves: no section indentation -->\n", out);
        return;
    }
    fputs("\n  <indentation>\n    <!-- sphere:radius=5um, pyramid:half-angle=20deg,radius=20nm ... "
          "-->\n    <tip>",
          out);
    put_text(out, c->tip != NULL ? c->tip : FILL_IN);
    fputs("</tip>\n", out);
    put_section(out, c, BULK, "    <bulk>\n", "files", "    </bulk>\n");
    put_section(out, c, TRACK, "    <track>\n", "files", "    </track>\n");
    fputs("  </indentation>\n", out);
}

static void put_material(FILE *out, const new_case *c)
{
    if (!put_section(
            out, c, DMA,
            "\n  <dma>\n    <!-- <reference-temperature>20degC</reference-temperature>, else "
            "that of the middle isotherm -->\n",
            "files", "  </dma>\n"))
        fputs("\n  <!-- no DMA sweeps: no section dma -->\n", out);
}

static void put_roughness(FILE *out, const new_case *c)
{
    if (count_entries(c, ROUGHNESS) == 1) {
        put_section(out, c, ROUGHNESS, "\n  <roughness>\n    <spectrum>\n", "file",
                    "    </spectrum>\n  </roughness>\n");
        return;
    }
    if (put_section(out, c, MAPS,
                    "\n  <roughness>\n    <!-- Maps and profiles of the counter surface, of "
                    "several places at best; no images of spots. -->\n",
                    "files", "  </roughness>\n"))
        return;
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
          "    <specific-wear-rate>" FILL_IN
          ", such as 1e-3mm^3/(N m); may be left out where a record tells "
          "what was worn</specific-wear-rate>\n"
          "    <critical-energy>" FILL_IN ", such as 2e10J/m^3</critical-energy>\n"
          "    <observed-thickness>" FILL_IN ", such as 3um</observed-thickness>\n"
          "  </layer> -->\n",
          out);
    if (count_entries(c, BULK) > 0 && count_entries(c, TRACK) > 0)
        fprintf(out, "\n  <compare>\n    <track-to-bulk/>\n    <by-rate/>\n%s  </compare>\n",
                count_entries(c, DMA) > 0 ? "    <indentation-to-dma/>\n" : "");
    for (size_t i = 0; i < c->n; i++) {
        const entry *e = &c->entries[i];
        if (e->place != UNUSED)
            continue;
        fputs("  <!-- not used: ", out);
        put_comment(out, e->path);
        fputs(": ", out);
        put_comment(out, e->found.words);
        fputs(e->found.kind == WT_KIND_IMAGE   ? "; an image: of the counter surface it goes "
                                                 "into roughness as files, of a spot see "
                                                 "weartrack spot"
              : e->found.kind == WT_KIND_NOISE ? "; noise of a lever: see weartrack thermal"
              : e->found.is_result             ? "; a result of weartrack"
                                               : "",
              out);
        fputs(" -->\n", out);
    }
}

static wt_status write_case(new_case *c)
{
    wt_error *err = &c->s->err;
    cmd_sink sink;
    wt_status status = cmd_sink_open(c->s->common.output, &sink, err);
    if (status == WT_OK) {
        fputs("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
              "<!-- What stands here as " FILL_IN " is in no file: put the value there, with its "
              "unit. Then:\n     weartrack run with the name of this file. See weartrack-case(5). "
              "-->\n<case version=\"1\">\n  <!-- <title>what the report is called</title> -->\n",
              sink.stream);
        put_indentation(sink.stream, c);
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

static const wt_param rows[] = {
    {PARAM_TEXT_OF("tip", new_case, tip), .value = "TIP", .unset = "",
     .help = "tip of the cantilever, as that of weartrack indent"},
};
CMD_OPTIONS(own_params, new_case, rows)

int cmd_new_case(int argc, char **argv)
{
    static const cmd_usage usage = {
        .name = "new-case",
        .arguments = "[OPTION]... FILE...",
        .what =
            "Writes a commented case file (weartrack-case(5)) for the files (folders, with the "
            "folders in them, and patterns): force curves as bulk or track, by the names of their "
            "folders; DMA sweeps; a power spectrum or height maps of the counter surface. What no "
            "file says stands there as " FILL_IN ".",
        .common = "output formats files-from",
        .notes =
            "Exit status 3 if a file was not understood, 1 if none was; the case names it in a "
            "comment.",
        .n_files = CMD_SOME};
    cmd_session s = cmd_session_defaults();
    new_case c = {.s = &s};
    cmd_part part = {own_params(), &c, NULL, 0};
    if (!cmd_parse(&s, &usage, &part, 1, argc, argv) || !cmd_is_text(&s) ||
        !cmd_begin_reading(&s, NULL))
        return cmd_session_free(&s);
    wt_status made = WT_OK;
    for (size_t i = 0; i < s.n_files && made == WT_OK; i++)
        made = add_argument(&c, s.files[i]);
    if (made == WT_OK && c.n == 0)
        made = wt_fail(&s.err, WT_E_EMPTY, "no file: no case is written");
    if (made == WT_OK) {
        guess_groups(&c);
        guess_maps(&c);
        if (s.status == CMD_PARTLY && count_entries(&c, UNUSED) == c.n)
            s.status = CMD_FAILED;
        made = write_case(&c);
        cmd_say_log(&s, s.log, false);
    }
    if (made != WT_OK)
        cmd_fail(&s);
    else if (s.common.output != NULL && !s.common.quiet && s.status != CMD_FAILED)
        cmd_say("next: fill in what is missing, then weartrack run %s\n", s.common.output);
    for (size_t i = 0; i < c.n; i++) {
        free(c.entries[i].path);
        free(c.entries[i].in_case);
    }
    free(c.entries);
    return cmd_session_free(&s);
}
