/* Writes the records of parameters and tables into a page or a schema: prints FILE with new text
 * between markers. In the page of a subcommand this is the list of its options as in --help. In
 * weartrack-case(5) and weartrack-case.xsd it is the elements of a section.
 *     .\" options            .\" parameters SECTION     <!-- parameters SECTION -->
 *     .\" end                .\" end                    <!-- end -->
 * .\" table NAME marks the columns and keys of a table with its name in core/table/registry.h; a
 * page with one table has all of them. .\" subcommands, .\" results and .\" figures mark their
 * lists, .\" limits the limits of every number of a case or an option.
 * <!-- choices --> marks the types of parameters whose values are words.
 * After SECTION, "= NAME..." selects these parameters and "but NAME..." all others.
 * Usage: docs_records PROGRAM FILE. SPDX-License-Identifier: GPL-3.0-or-later */
#include "case/resources.h"
#include "core/base/quantity.h"
#include "core/table/registry.h"
#include "indentation/law/tip.h"
#include "params/sections.h"
#include "weartrack/case.h"

#include <stdlib.h>
#include <string.h>

enum { LINE = 1024, SET = 256, TEXT = 2048 };

/* ---- troff ----------------------------------------------------------------------------------- */

/* Escapes text for troff; a long word may be broken after a comma or colon. */
static void put_troff(const char *text)
{
    for (const char *p = text; *p != '\0'; p++) {
        const bool option = p[0] == '-' && p[1] == '-' && p[2] >= 'a' && p[2] <= 'z';
        if (option) {
            const size_t n = 2 + strspn(p + 2, "abcdefghijklmnopqrstuvwxyz-");
            printf("\\fB\\-\\-");
            for (const char *q = p + 2; q < p + n; q++)
                printf(*q == '-' ? "\\-" : "%c", *q);
            printf("\\fR");
            p += n - 1;
        } else if (*p == '-') {
            printf("\\-");
        } else if (*p == '\\') {
            printf("\\e");
        } else {
            putchar(*p);
            if (strchr(",:", *p) != NULL && p[1] != ' ' && p[1] != '\0')
                printf("\\:");
        }
    }
}

static void put_name(const char *name, const char *unit)
{
    printf("\\fB");
    put_troff(name);
    printf("\\fR");
    if (unit[0] != '\0' && strcmp(unit, "1") != 0)
        printf(" [%s]", unit);
}

/* Prints a sentence: with a capital letter and a full stop. */
static void put_sentence(const char *text)
{
    char first[] = {text[0], '\0'};
    const size_t word = strspn(text, "abcdefghijklmnopqrstuvwxyz-");
    if (word > 1 && strchr(" ,;", text[word]) != NULL) /* text other than a formula or input */
        first[0] = (char)(text[0] - 'a' + 'A');
    printf("\\&%s", first);
    put_troff(text + 1);
    puts(".");
}

/* ---- options of a subcommand ----------------------------------------------------------------- */

typedef struct option {
    char letter, name[64], value[64], text[TEXT];
} option;

static void put_option(const option *o)
{
    if (o->name[0] == '\0')
        return;
    puts(".TP");
    if (o->letter != '\0')
        printf("\\fB\\-%c\\fR, ", o->letter);
    put_troff(o->name);
    if (o->value[0] != '\0')
        printf(" \\fI%s\\fR", o->value);
    putchar('\n');
    put_sentence(o->text);
}

/* Names of the options that another page describes, as one entry; `head` is their subject. */
static void put_other_options(FILE *help, const char *head, size_t length)
{
    char line[LINE], text[LINE];
    const char *parted = ".TP\n";
    snprintf(text, sizeof text, "%.*s, as in weartrack-master(1)", (int)length, head);
    while (fgets(line, sizeof line, help) != NULL && strncmp(line, "      --", 8) == 0) {
        line[6 + strcspn(line + 6, " \n")] = '\0';
        fputs(parted, stdout);
        put_troff(line + 6);
        parted = ", ";
    }
    putchar('\n');
    put_sentence(text);
    /* otherwise the command writes into a closed pipe */
    while (fgets(line, sizeof line, help) != NULL)
        continue;
}

/* Reads the list of options from the help. */
static bool put_options(const char *program, const char *subcommand)
{
    char command[LINE], line[LINE];
    option o = {0};
    bool in_list = false;
    snprintf(command, sizeof command, "\"%s\" %s --help all", program, subcommand);
    FILE *help = popen(command, "r");
    while (help != NULL && fgets(line, sizeof line, help) != NULL) {
        line[strcspn(line, "\n")] = '\0';
        if (strcmp(line, "options:") == 0) {
            in_list = true;
            continue;
        }
        const char *dashes = strstr(line, "--");
        char *rest = line + strspn(line, " ");
        const char *told = strstr(line, ", as in weartrack master --help all:");
        if (told != NULL) {
            put_option(&o);
            o = (option){.letter = '\0'};
            put_other_options(help, line, (size_t)(told - line));
            break;
        }
        if (!in_list || *rest == '\0') {
            in_list = in_list && *rest != '\0';
            continue;
        }
        if (dashes != NULL && dashes - line == 6) {
            put_option(&o);
            o = (option){.letter = line[2] == '-' ? line[3] : '\0'};
            rest = (char *)dashes;
            snprintf(o.name, sizeof o.name, "%.*s", (int)strcspn(rest, " "), rest);
            rest += strcspn(rest, " ");
            if (rest[0] == ' ' && rest[1] != ' ' && rest[1] != '\0') {
                rest++;
                snprintf(o.value, sizeof o.value, "%.*s", (int)strcspn(rest, " "), rest);
                rest += strcspn(rest, " ");
            }
            rest += strspn(rest, " ");
        }
        const size_t used = strlen(o.text);
        snprintf(o.text + used, sizeof o.text - used, "%s%s", used > 0 && *rest ? " " : "", rest);
    }
    put_option(&o);
    return help != NULL && pclose(help) == 0;
}

/* ---- elements of a section ------------------------------------------------------------------- */

static const char *schema_type(const wt_param *param, const char *name)
{
    switch (param->kind) {
    case PARAM_FLAG:
        return "yes-no";
    case PARAM_CHOICE:
        return name;
    case PARAM_TEXT:
    case PARAM_OTHER:
        return "name";
    default:
        return "quantity";
    }
}

/* True inside an xs:sequence of the schema; xs:all allows no element twice. */
static bool in_sequence;

static void put_element(const wt_param *param, const char *name, const char *set,
                        const char *indent)
{
    const bool required = (param->flags & PARAM_REQUIRED) != 0;
    if (indent != NULL) {
        printf("%s<xs:element name=\"%s\" type=\"%s\"%s%s/>\n", indent, name,
               schema_type(param, name), required ? "" : " minOccurs=\"0\"",
               param->kind == PARAM_TEXTS && in_sequence ? " maxOccurs=\"unbounded\"" : "");
        return;
    }
    char text[TEXT];
    printf(".TP\n.B <");
    put_troff(name);
    puts(">");
    snprintf(text, sizeof text, "%s%s%s%s%s",
             param->kind == PARAM_FLAG     ? "yes or no: "
             : param->kind == PARAM_CHOICE ? param->value
                                           : "",
             param->kind == PARAM_CHOICE ? ": " : "", param->help,
             required         ? "; required"
             : set[0] != '\0' ? "; default: "
                              : "",
             set);
    put_sentence(text);
}

static bool is_listed(const char *names, const char *name)
{
    const size_t n = strlen(name);
    for (const char *p = names; (p = strstr(p, name)) != NULL; p++)
        if ((p == names || p[-1] == ' ') && (p[n] == ' ' || p[n] == '\0'))
            return true;
    return false;
}

/* `what` is "SECTION", "SECTION = NAME..." or "SECTION but NAME..."; indent NULL means a page. */
static bool put_section(const char *what, const char *indent)
{
    char section[64];
    int n = 0;
    sscanf(what, "%63s %n", section, &n);
    const char *names = what + n;
    const bool only = strncmp(names, "= ", 2) == 0, but = strncmp(names, "but ", 4) == 0;
    for (size_t s = 0; s < N_CASE_SECTIONS; s++) {
        if (strcmp(case_sections[s].name, section) != 0)
            continue;
        for (size_t t = 0; t < SECTION_TABLES && case_sections[s].params[t] != NULL; t++) {
            const wt_params *params = case_sections[s].params[t]();
            for (size_t i = 0; i < wt_params_count(params); i++) {
                const wt_param *param = wt_params_get(params, i);
                const char *name = case_param_name(section, param->name);
                char set[SET];
                if ((param->flags & PARAM_NO_CASE) != 0 ||
                    ((only || but) && is_listed(names, param->name) != only))
                    continue;
                wt_params_default(params, i, set, sizeof set);
                put_element(param, name, set, indent);
            }
        }
        return true;
    }
    return false;
}

/* A parameter that an earlier section also has gets the same type. */
static bool is_in_earlier_section(size_t s, const char *name)
{
    for (size_t i = 0; i < s; i++)
        for (size_t t = 0; t < SECTION_TABLES && case_sections[i].params[t] != NULL; t++)
            for (size_t k = 0; k < wt_params_count(case_sections[i].params[t]()); k++)
                if (strcmp(case_param_name(case_sections[i].name,
                                           wt_params_get(case_sections[i].params[t](), k)->name),
                           name) == 0)
                    return true;
    return false;
}

/* Types of the parameters whose values are words. */
static void put_choices(const char *indent)
{
    for (size_t s = 0; s < N_CASE_SECTIONS; s++)
        for (size_t t = 0; t < SECTION_TABLES && case_sections[s].params[t] != NULL; t++)
            for (size_t i = 0; i < wt_params_count(case_sections[s].params[t]()); i++) {
                const wt_param *param = wt_params_get(case_sections[s].params[t](), i);
                if (param->kind != PARAM_CHOICE || (param->flags & PARAM_NO_CASE) != 0 ||
                    is_in_earlier_section(s, case_param_name(case_sections[s].name, param->name)))
                    continue;
                printf("%s<xs:simpleType name=\"%s\">\n", indent,
                       case_param_name(case_sections[s].name, param->name));
                printf("%s  <xs:restriction base=\"xs:token\">\n", indent);
                for (const char *p = param->value; *p != '\0'; p += strspn(p, "|")) {
                    const int n = (int)strcspn(p, "|");
                    printf("%s    <xs:enumeration value=\"%.*s\"/>\n", indent, n, p);
                    p += n;
                }
                printf("%s  </xs:restriction>\n%s</xs:simpleType>\n", indent, indent);
            }
}

/* ---- limits ---------------------------------------------------------------------------------- */

/* Intersection of the parameter's limits and the plausible range of the quantity. */
static void put_limit(const wt_param *param)
{
    const param_limits *l = &param->limits;
    const double most =
        param->kind == PARAM_COUNT ? (double)INFINITY : quantity_plausible_maximum(param->quantity);
    const bool with_low = l->with_low || l->low < -most, with_high = l->with_high || l->high > most;
    const double low = fmax(l->low, -most), high = fmin(l->high, most);
    char text[TEXT];
    puts(".TP 38");
    put_name(param->name, wt_quantity_unit(param->quantity));
    putchar('\n');
    if (isinf(high))
        snprintf(text, sizeof text, "%s%g%s", with_low ? "" : "above ", low,
                 with_low ? " or more" : "");
    else
        snprintf(text, sizeof text, "%s %g%s%g", with_low ? "from" : "above", low,
                 with_high && !with_low ? ", up to "
                 : with_high            ? " to "
                                        : " to below ",
                 high);
    put_troff(text);
    putchar('\n');
}

typedef const wt_params *params_of(void);

static void put_limits_of(const char *title, params_of *const *tables)
{
    char names[TEXT] = "";
    printf(".SS ");
    put_troff(title);
    putchar('\n');
    for (size_t t = 0; t < SECTION_TABLES && tables[t] != NULL; t++)
        for (size_t i = 0; i < wt_params_count(tables[t]()); i++) {
            const wt_param *param = wt_params_get(tables[t](), i);
            const size_t used = strlen(names);
            if (param->kind > PARAM_COUNT || is_listed(names, param->name) ||
                (param->flags & PARAM_ONLY_C) == PARAM_ONLY_C)
                continue;
            snprintf(names + used, sizeof names - used, " %s", param->name);
            put_limit(param);
        }
}

static void put_limits(void)
{
    puts(".PD 0");
    for (size_t s = 0; s < N_CASE_SECTIONS; s++)
        put_limits_of(case_sections[s].name, case_sections[s].params);
    puts(".SS tip");
    for (size_t i = 0; i < TIP_N_DIMENSIONS; i++)
        put_limit(&tip_dimensions[i]);
    put_limits_of("prony", (params_of *const[SECTION_TABLES]){case_prony_params, case_term_params});
    put_limits_of("files that are read", (params_of *const[SECTION_TABLES]){wt_read_params});
    put_limits_of("options of the work",
                  (params_of *const[SECTION_TABLES]){wt_run_params, wt_accuracy_job_params,
                                                     wt_report_params});
    puts(".PD");
}

/* ---- tables ---------------------------------------------------------------------------------- */

#define TABLE_NAME(name, ...) #name,
static const char *const table_names[] = {TABLES(TABLE_NAME)};
enum { N_TABLES = sizeof table_names / sizeof table_names[0] };
static bool table_put[N_TABLES];

static void put_columns(const table_schema *schema)
{
    puts(".PD 0");
    for (size_t i = 0; i < schema->n_columns; i++) {
        const schema_field *c = &schema->columns[i];
        puts(".TP 38");
        put_name(c->name, schema_unit(c));
        puts(c->kind == SCHEMA_TEXT ? " (text)" : "");
        put_sentence(c->long_name);
    }
    puts(".PD");
}

static void put_keys(const table_schema *schema)
{
    if (schema->n_keys > 0)
        puts(".PP\nKeys:");
    for (size_t i = 0; i < schema->n_keys; i++) {
        const schema_field *k = &schema->keys[i];
        char name[SCHEMA_NAME_SIZE];
        schema_name(k->name, "GROUP", name);
        if (k->optional)
            putchar('(');
        put_name(name, schema_unit(k));
        printf("%s%s%s\n", k->kind == SCHEMA_NUMBER ? " E" : "", k->optional ? ")" : "",
               i + 1 < schema->n_keys ? "," : ".");
    }
}

static bool put_table(const char *name)
{
    for (size_t i = 0; i < N_TABLES; i++) {
        if (strcmp(table_names[i], name) != 0)
            continue;
        char called[SCHEMA_NAME_SIZE];
        schema_name(table_schemas[i]->name,
                    table_schemas[i] == &indentation_schema ? "GROUP" : "NUMBER", called);
        table_put[i] = true;
        printf(".SS %s\n", called);
        put_sentence(table_schemas[i]->title);
        put_columns(table_schemas[i]);
        put_keys(table_schemas[i]);
        return true;
    }
    return false;
}

/* True if a page with tables has all of them. */
static bool has_all_tables(const char *path)
{
    bool any = false, all = true;
    for (size_t i = 0; i < N_TABLES; i++)
        any = any || table_put[i];
    for (size_t i = 0; any && i < N_TABLES; i++) {
        if (!table_put[i])
            fprintf(stderr, "%s: lacks the lines .\\\" table %s and .\\\" end\n", path,
                    table_names[i]);
        all = all && table_put[i];
    }
    return all;
}

/* ---- lists of names -------------------------------------------------------------------------- */

/* Reads them from the help. */
static bool put_subcommands(const char *program)
{
    char command[LINE], line[LINE], name[64];
    size_t put = 0;
    snprintf(command, sizeof command, "\"%s\" --help", program);
    FILE *help = popen(command, "r");
    while (help != NULL && fgets(line, sizeof line, help) != NULL) {
        int n = 0;
        line[strcspn(line, "\n")] = '\0';
        if (line[0] != ' ' || sscanf(line, " %63[a-z-] %n", name, &n) != 1 ||
            strcmp(name, "help") == 0)
            continue;
        printf(".TP\n.BR weartrack-%s (1)\n", name);
        put_troff(line + n);
        putchar('\n');
        put++;
    }
    return help != NULL && pclose(help) == 0 && put > 0;
}

static void put_names(const char *const *names, size_t n)
{
    for (size_t i = 0; i < n; i++)
        printf(".IR %s %s\n", names[i], i + 1 < n ? "," : ".");
}

/* Tables that a case may request. */
static void put_results(void)
{
    static const char *const groups[] = {"bulk", "track"};
    static char called[2 * N_TABLES][SCHEMA_NAME_SIZE];
    const char *names[2 * N_TABLES];
    size_t n = 0;
    for (size_t i = 0; i < table_n_schemas; i++)
        for (size_t g = 0; g < 2; g++) {
            flow_resource_set things = 0;
            bool is_new = true;
            schema_name(table_schemas[i]->name, groups[g], called[n]);
            for (size_t k = 0; k < n; k++)
                is_new = is_new && strcmp(called[k], called[n]) != 0;
            if (is_new && flow_table_resources(called[n], &things) && things != 0) {
                names[n] = called[n];
                n++;
            }
        }
    put_names(names, n);
}

static void put_figures(void)
{
    const char *names[SET];
    size_t n = 0;
    for (; n < wt_figure_count() && n < SET; n++)
        names[n] = wt_figure_get(n).name;
    put_names(names, n);
}

/* ---- the file -------------------------------------------------------------------------------- */

static bool is_marker(const char *word)
{
    static const char *const starts[] = {".\\\" options",     ".\\\" parameters", ".\\\" table ",
                                         ".\\\" subcommands", ".\\\" results",    ".\\\" figures",
                                         ".\\\" limits",      "<!-- parameters",  "<!-- choices"};
    for (size_t i = 0; i < sizeof starts / sizeof starts[0]; i++)
        if (strncmp(word, starts[i], strlen(starts[i])) == 0)
            return true;
    return false;
}

static bool put_block(const char *line, const char *program, const char *path)
{
    char what[LINE], subcommand[64] = "";
    const char *name = strstr(path, "weartrack-");
    if (strcmp(line, ".\\\" options\n") == 0) {
        if (name != NULL)
            sscanf(name, "weartrack-%63[a-z-]", subcommand);
        return put_options(program, subcommand);
    }
    if (strcmp(line, ".\\\" subcommands\n") == 0)
        return put_subcommands(program);
    if (strcmp(line, ".\\\" results\n") == 0) {
        put_results();
        return true;
    }
    if (strcmp(line, ".\\\" figures\n") == 0) {
        put_figures();
        return true;
    }
    if (strcmp(line, ".\\\" limits\n") == 0) {
        put_limits();
        return true;
    }
    if (sscanf(line, ".\\\" parameters %1023[^\n]", what) == 1)
        return put_section(what, NULL);
    if (sscanf(line, ".\\\" table %1023s", what) == 1)
        return put_table(what);
    char indent[64] = "";
    snprintf(indent, sizeof indent, "%.*s", (int)strspn(line, " "), line);
    if (sscanf(line, " <!-- parameters %1023[^>]", what) == 1 && strstr(what, " --") != NULL) {
        *strstr(what, " --") = '\0';
        return put_section(what, indent);
    }
    if (strcmp(line + strlen(indent), "<!-- choices -->\n") == 0) {
        put_choices(indent);
        return true;
    }
    return false;
}

int main(int argc, char **argv)
{
    char line[LINE];
    bool inside = false;
    FILE *in = argc == 3 ? fopen(argv[2], "r") : NULL;
    if (in == NULL) {
        fprintf(stderr, "usage: docs_records PROGRAM FILE\n");
        return 2;
    }
    while (fgets(line, sizeof line, in) != NULL) {
        const char *word = line + strspn(line, " ");
        if (strcmp(word, "<xs:sequence>\n") == 0 || strcmp(word, "<xs:all>\n") == 0)
            in_sequence = strcmp(word, "<xs:sequence>\n") == 0;
        if (strcmp(word, ".\\\" end\n") == 0 || strcmp(word, "<!-- end -->\n") == 0)
            inside = false;
        if (inside)
            continue;
        fputs(line, stdout);
        if (is_marker(word)) {
            inside = true;
            fflush(stdout);
            if (!put_block(line, argv[1], argv[2])) {
                fprintf(stderr, "%s: nothing is known for %s", argv[2], line);
                return 1;
            }
        }
    }
    fclose(in);
    if (inside)
        fprintf(stderr, "%s: a marker without its end\n", argv[2]);
    return inside || !has_all_tables(argv[2]) ? 1 : 0;
}
