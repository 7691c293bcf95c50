/* Prints the remarks of a log and the failed files, in short on a terminal.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>
#include <unistd.h>

#include "cmd/cmd.h"
#include "core/table/registry.h"

/* Log entries with equal texts about several files. */
typedef struct log_group {
    wt_log_entry entry; /* the first of them */
    size_t first, n_files, n;
} log_group;

/* ---- on a terminal --------------------------------------------------------------------------- */

enum { LINES_OF_REMARKS = 2, LINES_OF_NEXT_CALL = 2 };

bool cmd_is_brief(const cmd_session *s)
{
    return !s->common.verbose && !cmd_log_is_json() && isatty(STDERR_FILENO);
}

/* Returns the number of bytes that fit into `width` characters, up to the end of a word if the text
 * is longer. */
static size_t fitting_length(const char *text, size_t width)
{
    size_t n = 0, word = 0, used = 0;
    for (; text[n] != '\0' && used <= width; n++) {
        if (text[n] == ' ')
            word = n;
        used += ((unsigned char)text[n] & 0xC0) != 0x80;
    }
    return used <= width ? n : word > 0 ? word : width;
}

/* Number of lines of a text beside a label. */
static size_t count_lines(const char *text)
{
    size_t lines = 0;
    do {
        text += fitting_length(text, CMD_SCREEN_WIDTH - CMD_LABEL_WIDTH);
        text += strspn(text, " ");
        lines++;
    } while (*text != '\0');
    return lines;
}

static void print_remark(const char *label, const char *text, bool whole)
{
    enum { ROOM = CMD_SCREEN_WIDTH - CMD_LABEL_WIDTH, DOTS = 4 };
    do {
        size_t n = fitting_length(text, ROOM);
        const bool cut = !whole && text[n] != '\0';
        if (cut)
            n = fitting_length(text, ROOM - DOTS);
        cmd_message("%-*s%.*s%s\n", CMD_LABEL_WIDTH, label, (int)n, text, cut ? " ..." : "");
        text += n;
        text += strspn(text, " ");
        label = "";
    } while (whole && *text != '\0');
}

/* Prints remarks with one label each: whole where all of them take few lines, else a line each, the
 * first ones. */
static void print_remarks(cmd_session *s, const char *const labels[], char *const texts[], size_t n,
                          size_t most)
{
    size_t lines = 0;
    for (size_t i = 0; i < n; i++)
        lines += count_lines(texts[i]);
    most = most > LINES_OF_REMARKS ? most : LINES_OF_REMARKS;
    const bool whole = lines <= most;
    const size_t shown = n < most || whole ? n : most - 1;
    for (size_t i = 0; i < shown; i++)
        print_remark(labels[i], texts[i], whole);
    if (n > shown)
        cmd_message("%-*sand %zu more kinds: --verbose\n", CMD_LABEL_WIDTH, "", n - shown);
    else if (!whole)
        cmd_message("%-*sin full: --verbose\n", CMD_LABEL_WIDTH, "");
    const size_t used = whole ? lines : shown + 1;
    s->lines_left -= used < s->lines_left ? used : s->lines_left;
}

static char *describe_group(const log_group *f)
{
    const wt_log_entry *e = &f->entry;
    const bool one = f->n_files == 1;
    char count[64] = "", *text = NULL;
    if (!one)
        snprintf(count, sizeof count, "%zu files: ", f->n_files);
    else if (f->n > 1)
        snprintf(count, sizeof count, "%zu times: ", f->n);
    if (asprintf(&text, "%s%s%s%s%s%s", count, one ? wt_path_base(e->file) : "",
                 one && *e->file ? ": " : "", one ? e->place : "", one && *e->place ? ": " : "",
                 e->text) < 0)
        cmd_exit_without_memory(strlen(e->text));
    return text;
}

/* The worst limit of a result is the first warning. The other remarks on a result, which are worse,
 * come after those on its data. */
static int compare_severity(const void *a, const void *b)
{
    const log_group *p = a, *q = b;
    if (p->entry.severity != q->entry.severity)
        return p->entry.severity > q->entry.severity ? -1 : 1;
    if (p->entry.topic != q->entry.topic)
        return p->entry.topic > q->entry.topic ? -1 : 1;
    return p->first > q->first ? -1 : 1;
}

/* The worst first. */
static void print_groups_briefly(cmd_session *s, log_group *groups, size_t n)
{
    const char **labels = wt_alloc(n + 1, sizeof *labels);
    char **texts = wt_alloc(n + 1, sizeof *texts);
    const size_t reserved = s->next != NULL ? LINES_OF_NEXT_CALL : 0;
    qsort(groups, n, sizeof *groups, compare_severity);
    for (size_t i = 0; i < n; i++) {
        labels[i] = wt_severity_name(groups[i].entry.severity);
        texts[i] = describe_group(&groups[i]);
    }
    print_remarks(s, labels, texts, n, s->lines_left - (s->lines_left > reserved ? reserved : 0));
    wt_strings_free(texts, n);
    free(labels);
}

static void print_failures_briefly(cmd_session *s, const wt_table *failures)
{
    const size_t n = wt_table_n_rows(failures);
    const char **labels = wt_alloc(n + 1, sizeof *labels);
    char **texts = wt_alloc(n + 1, sizeof *texts);
    for (size_t i = 0; i < n; i++) {
        const char *where = wt_table_text(failures, i, FAILURES_FILE);
        const char *what = wt_table_text(failures, i, FAILURES_MESSAGE);
        labels[i] = "failed";
        if (asprintf(&texts[i], "%s: %s", wt_path_base(where), what) < 0)
            cmd_exit_without_memory(strlen(what));
    }
    print_remarks(s, labels, texts, n,
                  s->lines_left - (s->lines_left > LINES_OF_REMARKS ? LINES_OF_REMARKS : 0));
    wt_strings_free(texts, n);
    free(labels);
}

/* ---- all of it ------------------------------------------------------------------------------- */

static void print_log_group(const char *name, const log_group *f)
{
    const wt_log_entry *e = &f->entry;
    const cmd_json_member words[] = {{"file", e->file, 0},
                                     {"place", f->n_files > 1 ? "" : e->place, 0},
                                     {"text", e->text, 0},
                                     {"files", NULL, f->n_files},
                                     {"times", NULL, f->n}};
    if (cmd_log_is_json()) {
        cmd_log_event(wt_severity_name(e->severity), words, COUNT_OF(words));
        return;
    }
    cmd_message("weartrack %s: %s: %s", name, wt_severity_name(e->severity), e->file);
    if (f->n_files > 1)
        cmd_message(" and %zu more", f->n_files - 1);
    cmd_message("%s%s%s%s", *e->file ? ": " : "", f->n_files > 1 ? "" : e->place,
                *e->place && f->n_files == 1 ? ": " : "", e->text);
    if (f->n > f->n_files)
        cmd_message(" (%zu times)", f->n);
    cmd_message("\n");
}

void cmd_print_log(cmd_session *s, const wt_log *log, bool notes)
{
    const bool quiet = s->common.quiet, strict = s->common.strict;
    const size_t n = wt_log_count(log);
    size_t n_folds = 0, n_remarks = 0, n_losses = 0;
    log_group *folds = wt_alloc(n + 1, sizeof *folds);
    size_t *fold = wt_alloc(n + 1, sizeof *fold); /* of each entry */
    for (size_t i = 0; i < n; i++) {
        const wt_log_entry e = wt_log_get(log, i);
        n_remarks += e.severity != WT_NOTE;
        n_losses += e.severity == WT_LOSS;
        if (e.severity != WT_LOSS && (quiet || (e.severity == WT_NOTE && !notes)))
            continue;
        fold[i] = e.like < i ? fold[e.like] : n_folds++;
        log_group *const group = &folds[fold[i]];
        if (e.like == i)
            *group = (log_group){.entry = e, .first = i};
        group->n_files++;
        group->n += e.count;
    }
    free(fold);
    if (cmd_is_brief(s))
        print_groups_briefly(s, folds, n_folds);
    for (size_t i = 0; i < n_folds && !cmd_is_brief(s); i++)
        print_log_group(s->name, &folds[i]);
    free(folds);
    if (n_remarks > 0 && (strict || (!quiet && !cmd_is_brief(s))))
        cmd_message("weartrack %s: %zu remark%s%s\n", s->name, n_remarks, n_remarks == 1 ? "" : "s",
                    strict ? ": exit status 1 (--strict)" : "");
    if (n_losses > 0)
        cmd_set_partial(s);
    if (strict && n_remarks > 0)
        s->status = CMD_FAILED;
}

bool cmd_print_failures(cmd_session *s, const wt_table *failures)
{
    const size_t n = failures != NULL ? wt_table_n_rows(failures) : 0;
    if (n == 0)
        return false;
    if (cmd_is_brief(s))
        print_failures_briefly(s, failures);
    else if (!cmd_log_is_json())
        cmd_message("weartrack %s: %zu failed:\n", s->name, n);
    for (size_t i = 0; i < n; i++) {
        const char *where = wt_table_text(failures, i, FAILURES_FILE);
        const char *what = wt_table_text(failures, i, FAILURES_MESSAGE);
        const cmd_json_member words[] = {{"file", where, 0}, {"text", what, 0}};
        cmd_log_event("failed", words, COUNT_OF(words));
        if (cmd_log_is_json() || cmd_is_brief(s))
            continue;
        cmd_message("  %s: %s\n", where, what);
    }
    const char *answered = wt_table_key(failures, "status");
    cmd_set_partial(s);
    if (answered != NULL && atoi(answered) == CMD_FAILED)
        s->status = CMD_FAILED;
    return true;
}
