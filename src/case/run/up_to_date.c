/* Decides if a result is current: the case would produce the same result again, because none of its
 * inputs changed. SPDX-License-Identifier: GPL-3.0-or-later */
#include "case/case.h"
#include "job/inputs.h"

#include "core/base/array.h"
#include "core/table/registry.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* State of the comparison, with the first difference found. */
typedef struct currency_check {
    const wt_case *c;
    const wt_result *result;
    const wt_provenance *inputs;
    char *reason;
    size_t size;
    bool differs;
} currency_check;

__attribute__((format(printf, 2, 3))) static void differs(currency_check *k, const char *format,
                                                          ...)
{
    va_list args;
    if (k->differs)
        return;
    va_start(args, format);
    vsnprintf(k->reason, k->size, format, args);
    va_end(args);
    k->differs = true;
}

/* Returns the length of the next word of a command. Options without influence on the result are
 * skipped with their values. */
static size_t next_relevant_argument(const char **at)
{
    static const struct {
        const char *name;
        bool has_value;
    } ignored[] = {{"--keep", false},   {"--quiet", false},  {"-q", false},
                   {"--strict", false}, {"--threads", true}, {"--log", true}};
    for (bool is_value = false;;) {
        *at += strspn(*at, " ");
        const size_t length = strcspn(*at, " ");
        bool is_ignored = is_value && length > 0;
        is_value = false;
        for (size_t i = 0; !is_ignored && i < COUNT_OF(ignored); i++) {
            const size_t n = strlen(ignored[i].name);
            const bool begins = length >= n && strncmp(*at, ignored[i].name, n) == 0;
            is_ignored = begins && (length == n || (ignored[i].has_value && (*at)[n] == '='));
            is_value = is_ignored && length == n && ignored[i].has_value;
        }
        if (!is_ignored)
            return length;
        *at += length;
    }
}

static bool is_same_command(const char *a, const char *b)
{
    for (;;) {
        const size_t n = next_relevant_argument(&a), m = next_relevant_argument(&b);
        if (n != m || strncmp(a, b, n) != 0)
            return false;
        if (n == 0)
            return true;
        a += n;
        b += n;
    }
}

static const wt_provenance_input *find_input(const wt_provenance *p, const char *name)
{
    for (size_t i = 0; i < wt_provenance_n_inputs(p); i++)
        if (strcmp(wt_provenance_get_input(p, i)->path, name) == 0)
            return wt_provenance_get_input(p, i);
    return NULL;
}

/* A file that cannot be read counts as changed; the run reports the cause. */
static void compare_file(currency_check *k, const flow_file *file,
                         const wt_provenance_input *before)
{
    wt_provenance *const now = wt_provenance_new();
    const wt_job work = {.provenance = now};
    wt_input *input = NULL;
    wt_status status = wt_input_open(file->path, &input, NULL);
    if (status == WT_OK)
        status = wt_job_add_input(&work, (wt_provenance_input){.path = file->name}, input, NULL);
    if (status != WT_OK || strcmp(wt_provenance_get_input(now, 0)->sha256, before->sha256) != 0)
        differs(k, "%s has changed", file->name);
    wt_input_close(input);
    wt_provenance_free(now);
}

/* Compares the files of one role. Either no file was read, because nothing needed them, or all were
 * read and none is new. `seen` counts the files that were read. */
static wt_status compare_role(currency_check *k, const case_files *role, size_t *seen,
                              wt_error *err)
{
    wt_log *log = wt_log_new();
    wt_table *failures = wt_failures_new();
    const wt_job work = {.log = log, .failures = failures};
    flow_files files = {0};
    wt_status status = flow_files_list(role->sets, role->n, &work, &files, err);
    size_t n_before = *seen;
    for (size_t i = 0; status == WT_OK && i < files.n; i++)
        *seen += find_input(k->inputs, files.file[i].name) != NULL;
    for (size_t i = 0; status == WT_OK && *seen > n_before && !k->differs && i < files.n; i++) {
        const wt_provenance_input *const before = find_input(k->inputs, files.file[i].name);
        if (before == NULL)
            differs(k, "%s is new", files.file[i].name);
        else
            compare_file(k, &files.file[i], before);
    }
    if (status == WT_OK && *seen > n_before && wt_table_n_rows(failures) > 0)
        differs(k, "a file that it was made of is gone");
    flow_files_clear(&files);
    wt_table_free(failures);
    wt_log_free(log);
    return status;
}

static wt_status compare_inputs(currency_check *k, wt_error *err)
{
    size_t seen = 1; /* the case file */
    wt_status status = WT_OK;
    for (const case_files *role = k->c->roles; status == WT_OK && !k->differs && role != NULL;
         role = role->next)
        status = compare_role(k, role, &seen, err);
    if (seen < wt_provenance_n_inputs(k->inputs))
        differs(k, "a file that it was made of is gone");
    return status;
}

static void compare_case(currency_check *k)
{
    size_t length = 0;
    const char *const before = wt_result_case(k->result, &length);
    if (before == NULL || length != k->c->xml_length || memcmp(before, k->c->xml, length) != 0)
        differs(k, "the case has changed");
}

wt_status wt_run_is_current(const wt_case *c, const wt_result *result, const char *command,
                            bool *current, char *reason, size_t size, wt_error *err)
{
    currency_check k = {.c = c,
                        .result = result,
                        .inputs = wt_result_provenance_const(result),
                        .reason = reason,
                        .size = size};
    const wt_table *const failures = wt_result_find(result, "failures");
    if (wt_provenance_command(k.inputs)[0] == '\0')
        differs(&k, "it does not say what it was made of (--no-provenance)");
    if (strcmp(wt_provenance_version(k.inputs), wt_version()) != 0)
        differs(&k, "it was made by another version of weartrack");
    if (!is_same_command(wt_provenance_command(k.inputs), command))
        differs(&k, "it was made by another command");
    if (failures != NULL && wt_table_n_rows(failures) > 0)
        differs(&k, "it is answered in part only");
    compare_case(&k);
    const wt_status status = k.differs ? WT_OK : compare_inputs(&k, err);
    *current = status == WT_OK && !k.differs;
    return status;
}
