/* Provenance of a result: the command and its input files. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#include "core/base/provenance.h"

#include "core/base/array.h"

#include <stdlib.h>
#include <string.h>

struct wt_provenance {
    char *version, *command; /* NULL: version of this program; no command */
    wt_provenance_input *inputs;
    size_t n;
};

wt_provenance *wt_provenance_new(void)
{
    return wt_alloc(1, sizeof(wt_provenance));
}

/* Consecutive inputs often have the same role and format and share these texts. */
static void input_free(wt_provenance_input *input, const wt_provenance_input *before)
{
    free((char *)input->path);
    if (before == NULL || input->role != before->role)
        free((char *)input->role);
    if (before == NULL || input->format != before->format)
        free((char *)input->format);
}

static const char *share_text(const char *text, const char *before)
{
    const char *const given = text != NULL ? text : "";
    return before != NULL && strcmp(given, before) == 0 ? before : wt_strdup(given);
}

void wt_provenance_free(wt_provenance *p)
{
    if (p == NULL)
        return;
    for (size_t i = p->n; i > 0; i--)
        input_free(&p->inputs[i - 1], i > 1 ? &p->inputs[i - 2] : NULL);
    free(p->inputs);
    free(p->version);
    free(p->command);
    free(p);
}

static bool is_shell_safe(const char *word)
{
    return word[0] != '\0' && word[strspn(word, "abcdefghijklmnopqrstuvwxyz"
                                                "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                                "0123456789_@%+=:,./-")] == '\0';
}

/* Writes a word with shell quoting and returns the end of the text. */
static char *quote_for_shell(char *to, const char *word)
{
    if (is_shell_safe(word))
        return stpcpy(to, word);
    *to++ = '\'';
    for (; *word != '\0'; word++) {
        if (*word == '\'')
            to = stpcpy(to, "'\\''");
        else
            *to++ = *word;
    }
    *to++ = '\'';
    *to = '\0';
    return to;
}

void wt_provenance_set_command(wt_provenance *p, int argc, char *const argv[])
{
    size_t size = 1;
    for (int i = 0; i < argc; i++)
        size += 4 * strlen(argv[i]) + 3;
    char *const command = wt_alloc(size, 1);
    char *to = command;
    *to = '\0';
    for (int i = 0; i < argc; i++) {
        if (i > 0)
            *to++ = ' ';
        /* The folder of the program does not affect the result. */
        to = quote_for_shell(to, i == 0 ? wt_path_base(argv[i]) : argv[i]);
    }
    free(p->command);
    p->command = command;
}

void provenance_restore(wt_provenance *p, const char *version_and_command)
{
    const size_t length = strcspn(version_and_command, "\n");
    const char *const rest = version_and_command + length;
    char *const version = wt_strndup(version_and_command, length);
    char *const command = wt_strdup(rest[0] != '\0' ? rest + 1 : rest);
    free(p->version);
    free(p->command);
    p->version = version;
    p->command = command;
}

void wt_provenance_add_input(wt_provenance *p, const wt_provenance_input *input)
{
    p->inputs = array_grow(p->inputs, p->n, sizeof *p->inputs);
    wt_provenance_input copy = *input;
    const wt_provenance_input *const before = p->n > 0 ? &p->inputs[p->n - 1] : NULL;
    copy.path = wt_strdup(input->path != NULL ? input->path : "");
    copy.role = share_text(input->role, before != NULL ? before->role : NULL);
    copy.format = share_text(input->format, before != NULL ? before->format : NULL);
    copy.sha256[sizeof copy.sha256 - 1] = '\0';
    p->inputs[p->n++] = copy;
}

const char *wt_provenance_version(const wt_provenance *p)
{
    return p->version != NULL ? p->version : wt_version();
}

const char *wt_provenance_command(const wt_provenance *p)
{
    return p->command != NULL ? p->command : "";
}

size_t wt_provenance_n_inputs(const wt_provenance *p)
{
    return p->n;
}

const wt_provenance_input *wt_provenance_get_input(const wt_provenance *p, size_t i)
{
    return &p->inputs[i];
}
