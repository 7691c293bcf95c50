/* Results: the tables of one run. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/array.h"
#include "core/base/memory.h"
#include "core/table/table.h"

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

/* Consecutive inputs often have the same group and format and share these texts. */
static void input_free(wt_provenance_input *input, const wt_provenance_input *before)
{
    free((char *)input->path);
    if (before == NULL || input->group != before->group)
        free((char *)input->group);
    if (before == NULL || input->format != before->format)
        free((char *)input->format);
    if (before == NULL || input->instrument != before->instrument)
        free((char *)input->instrument);
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
    copy.group = share_text(input->group, before != NULL ? before->group : NULL);
    copy.format = share_text(input->format, before != NULL ? before->format : NULL);
    copy.instrument = share_text(input->instrument, before != NULL ? before->instrument : NULL);
    copy.sha256[sizeof copy.sha256 - 1] = '\0';
    p->inputs[p->n++] = copy;
}

const char *wt_provenance_input_role(const wt_provenance_input *input)
{
#define ROLE_TEXT(name, text) [name] = (text),
    static const char *const texts[] = {WT_INPUT_ROLE_LIST(ROLE_TEXT)};
#undef ROLE_TEXT
    return input->role < WT_ROLE_GROUP ? texts[input->role] : input->group;
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

/* Tables, and figures that have the name of their table. */
static const struct {
    const char *former, *name;
} tables[] = {
    {"choices", "overrides"},
    {"directions", "transverse_isotropy"},
};

/* A former name that ends in '_' stands for all names that begin with it. */
static const struct {
    const char *table; /* name of today of the table; NULL: any table */
    const char *former, *name;
} members[] = {
    {"angular_spectrum", "chance", "p_value"},
    {"angular_spectrum", "chance_fourth", "p_value_fourth"},
    {"cost", "because", "reason"},
    {"error_budget", "lacks", "excluded_errors"},
    {"modulus_depth", "chance_", "p_value_"},
    {"plan", "because", "reason"},
    {"plan", "gives", "produces"},
    {"prony_reduced", "better", "preferred_model"},
    {"what_if", "tried", "alternative"},
    {NULL, "anisotropy_chance", "anisotropy_p"},
    {NULL, "baseline_chance", "baseline_p"},
    {NULL, "holds_from", "valid_from"},
    {NULL, "holds_to", "valid_to"},
    {NULL, "lack_of_fit_chance", "lack_of_fit_p"},
    {NULL, "misfit_chance", "misfit_p"},
    {NULL, "misfit_chance_", "misfit_p_"},
    {NULL, "n_accepted", "n_used"},
    {NULL, "pooled_misfit_chance", "pooled_misfit_p"},
    {NULL, "standard_error_lacks", "standard_error_excludes"},
    {NULL, "ways_error", "direction_error"},
};

const char *table_current_name(const char *name)
{
    for (size_t i = 0; i < COUNT_OF(tables); i++)
        if (strcmp(tables[i].former, name) == 0)
            return tables[i].name;
    return name;
}

/* Replaces *name if it is a former name of a column or key of the table. */
static void replace_member(const char *table, char **name)
{
    for (size_t i = 0; i < COUNT_OF(members); i++) {
        const size_t n = strlen(members[i].former);
        const bool is_prefix = members[i].former[n - 1] == '_';
        if ((members[i].table != NULL && strcmp(members[i].table, table) != 0) ||
            strncmp(members[i].former, *name, n) != 0 || (!is_prefix && (*name)[n] != '\0'))
            continue;
        char *const current = format_text("%s%s", members[i].name, *name + n);
        free(*name);
        *name = current;
        return;
    }
}

/* Replaces a former verdict. The reason after it stays: "cannot say: too few spots". */
static void replace_verdict(char **text)
{
    static const char former[] = "cannot say";
    const size_t n = sizeof former - 1;
    if (*text == NULL || strncmp(*text, former, n) != 0)
        return;
    char *const current = format_text("inconclusive%s", *text + n);
    free(*text);
    *text = current;
}

/* Consecutive cells may share one text. */
static void replace_verdicts(char **texts, size_t n_rows)
{
    for (size_t row = 0, end; row < n_rows; row = end) {
        for (end = row + 1; end < n_rows && texts[end] == texts[row]; end++)
            ;
        replace_verdict(&texts[row]);
        for (size_t i = row + 1; i < end; i++)
            texts[i] = texts[row];
    }
}

void table_use_current_names(wt_table *table)
{
    const char *current = table_current_name(table->name);
    if (current != table->name) {
        free(table->name);
        table->name = wt_strdup(current);
    }
    for (size_t i = 0; i < table->n_columns; i++) {
        replace_member(table->name, &table->columns[i].name);
        if (table->columns[i].texts != NULL)
            replace_verdicts(table->columns[i].texts, table->n_rows);
    }
    for (size_t i = 0; i < table->n_keys; i++) {
        replace_member(table->name, &table->keys[i].name);
        replace_verdict(&table->keys[i].text);
    }
}

struct wt_result {
    wt_table **tables;
    size_t n;
    wt_provenance *provenance;
    char *case_file; /* with a terminating zero that the length does not count */
    size_t case_length;
};

wt_result *wt_result_new(void)
{
    wt_result *const result = wt_alloc(1, sizeof *result);
    result->provenance = wt_provenance_new();
    return result;
}

void wt_result_free(wt_result *result)
{
    if (result == NULL)
        return;
    for (size_t i = 0; i < result->n; i++)
        wt_table_free(result->tables[i]);
    free(result->tables);
    wt_provenance_free(result->provenance);
    free(result->case_file);
    free(result);
}

/* True if one name equals the other or is a folder of it: a table cannot contain tables. */
static bool names_collide(const char *a, const char *b)
{
    while (*a != '\0' && *a == *b) {
        a++;
        b++;
    }
    return (*a == '\0' && (*b == '\0' || *b == '/')) || (*b == '\0' && *a == '/');
}

wt_status wt_result_add(wt_result *result, wt_table *table, wt_error *err)
{
    wt_status status = WT_OK;
    if (!table_name_is_valid(table->name) || names_collide(table->name, "case") ||
        names_collide(table->name, "provenance")) {
        status = wt_fail(err, WT_E_ARG, "not a name for a table");
        wt_error_expected(err, "a to z, digits and '_' in parts joined by '/', but not \"case\" "
                               "or \"provenance\"");
        wt_error_found(err, "\"%s\"", table->name);
    } else if (result->n >= RESULT_TABLES_MAX) {
        status = wt_fail(err, WT_E_ARG, "more than %d tables", (int)RESULT_TABLES_MAX);
        wt_error_advice(err, "write a text stream (-o NAME.tsv), which holds any number");
    }
    for (size_t i = 0; status == WT_OK && i < result->n; i++)
        if (names_collide(result->tables[i]->name, table->name))
            status = wt_fail(err, WT_E_ARG, "tables \"%s\" and \"%s\" collide",
                             result->tables[i]->name, table->name);
    if (status == WT_OK) {
        result->tables = array_grow(result->tables, result->n, sizeof *result->tables);
        result->tables[result->n++] = table;
    } else {
        wt_table_free(table);
    }
    return status;
}

size_t wt_result_n_tables(const wt_result *result)
{
    return result->n;
}

const wt_table *wt_result_table(const wt_result *result, size_t i)
{
    return result->tables[i];
}

const wt_table *wt_result_find(const wt_result *result, const char *name)
{
    const char *current = table_current_name(name);
    for (size_t i = 0; i < result->n; i++) {
        if (strcmp(result->tables[i]->name, current) == 0)
            return result->tables[i];
    }
    return NULL;
}

wt_provenance *wt_result_provenance(wt_result *result)
{
    return result->provenance;
}

const wt_provenance *wt_result_provenance_const(const wt_result *result)
{
    return result->provenance;
}

void wt_result_set_case(wt_result *result, const char *xml, size_t length)
{
    char *const copy = length > 0 ? wt_strndup(xml, length) : NULL;
    free(result->case_file);
    result->case_file = copy;
    result->case_length = length;
}

const char *wt_result_case(const wt_result *result, size_t *length)
{
    if (length != NULL)
        *length = result->case_length;
    return result->case_file;
}
