/* Reads translations in the PO format of gettext.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/translations.h"

#include "report/report_files.h"

#include "report/languages_embedded.h"

#include <stdlib.h>
#include <string.h>

static const char english[] = "en";

/* ---- parsing --------------------------------------------------------------------------------- */

/* Writes one quoted part of a text without quotes and escapes to `to`; returns its end. */
static char *unquote(const char *line, const char *end, char *to)
{
    const char *s = memchr(line, '"', (size_t)(end - line));
    for (s = s != NULL ? s + 1 : end; s < end && *s != '"'; s++) {
        const bool escaped = *s == '\\' && s + 1 < end;
        s += escaped;
        *to++ = escaped && *s == 'n' ? '\n' : *s;
    }
    return to;
}

static bool starts_with(const char *line, const char *word)
{
    return strncmp(line, word, strlen(word)) == 0;
}

/* Reads the pairs of texts of a PO file, consecutively into `bytes`, which is as large as the file.
 * Empty or fuzzy translations are skipped. */
static void read_translations(language *l, const char *po)
{
    char *to = l->bytes;
    const char *word = NULL, *last = NULL; /* English text, and the translation being read */
    bool fuzzy = false, next_fuzzy = false;
    for (const char *line = po; *line != '\0';) {
        const char *end = strchrnul(line, '\n');
        const bool id = starts_with(line, "msgid "), text = starts_with(line, "msgstr ");
        if (starts_with(line, "#, fuzzy"))
            next_fuzzy = true;
        if (id) {
            fuzzy = next_fuzzy;
            next_fuzzy = false;
            word = to;
        } else if (text && word != NULL) {
            *to++ = '\0';
            last = to;
            l->sentences[l->n++] = (translation){word, last};
        } else if (line[0] != '"') {
            line = *end != '\0' ? end + 1 : end;
            continue;
        }
        to = unquote(line, end, to);
        line = *end != '\0' ? end + 1 : end;
        if (last != NULL && *line != '"') {
            *to++ = '\0';
            if (fuzzy || word[0] == '\0' || last[0] == '\0')
                l->n--;
            word = last = NULL;
        }
    }
}

static int compare_translations(const void *a, const void *b)
{
    return strcmp(((const translation *)a)->english, ((const translation *)b)->english);
}

static size_t count_translations(const char *po)
{
    size_t n = 1;
    for (const char *s = po; (s = strstr(s, "\nmsgid ")) != NULL; s++)
        n++;
    return n;
}

/* ---- by name --------------------------------------------------------------------------------- */

/* Finds the translations of a language, "de.po" for "de". */
static const embedded_text *find_translations(const char *name)
{
    const embedded_text *file = languages_embedded;
    while (file->name != NULL &&
           (strlen(file->name) != strlen(name) + strlen(".po") || !starts_with(file->name, name)))
        file++;
    return file->name != NULL ? file : NULL;
}

wt_status language_check(const void *member, wt_error *err)
{
    const char *const name = *(const char *const *)member;
    char names[64] = "";
    if (name == NULL || strcmp(name, english) == 0 || find_translations(name) != NULL)
        return WT_OK;
    for (const embedded_text *file = languages_embedded; file->name != NULL; file++)
        (void)snprintf(names + strlen(names), sizeof names - strlen(names), "%.*s, ",
                       (int)(strlen(file->name) - strlen(".po")), file->name);
    const wt_status status = wt_fail(err, WT_E_ARG, "no language of that name");
    wt_error_expected(err, "%s%s", names, english);
    wt_error_found(err, "\"%s\"", name);
    return status;
}

/* All translated languages have a decimal comma. */
static const char decimal_comma = ',';

wt_status language_open(const char *name, language **l, wt_error *err)
{
    *l = NULL;
    const wt_status status = language_check(&name, err);
    if (status != WT_OK || name == NULL || strcmp(name, english) == 0)
        return status;
    const embedded_text *const file = find_translations(name);
    language *const made = calloc(1, sizeof *made);
    if (made != NULL) {
        made->bytes = malloc(file->length + 1);
        made->sentences = calloc(count_translations(file->text), sizeof *made->sentences);
    }
    if (made == NULL || made->bytes == NULL || made->sentences == NULL) {
        language_close(made);
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    }
    (void)snprintf(made->tag, sizeof made->tag, "%s", name);
    made->decimal_mark = decimal_comma;
    read_translations(made, file->text);
    qsort(made->sentences, made->n, sizeof *made->sentences, compare_translations);
    *l = made;
    return WT_OK;
}

void language_close(language *l)
{
    if (l == NULL)
        return;
    free(l->bytes);
    free(l->sentences);
    free(l);
}
