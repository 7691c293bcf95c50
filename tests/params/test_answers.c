/* An option, a case and a call from C apply the same rule: each accepts or refuses the same values.
 * Tried values are the limits of the range, values outside it, NaN, a wrong unit and empty text.
 * They follow from the records, so a new parameter needs no line here.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"
#include "call_text.h"
#include "core/base/quantity.h"
#include "params/sections.h"

#include <limits.h>
#include <stdalign.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>

enum { TEXT = 4096 };

/* Required parameters beside the tested one, in options and in cases. */
static const struct {
    const char *name, *text;
} good[] = {
    {"tip", "sphere:radius=5um"},
    {"pressure", "1MPa"},
    {"velocity", "1m/s"},
    {"specific-wear-rate", "1e-12m^2/N"},
    {"critical-energy", "1e10J/m^3"}, /* omitted if the alternative is tested */
    {"q0", "1e3rad/m"},
    {"q1", "1e6rad/m"},
    {"hurst", "0.8"},
    {"c0", "1e-17m^4"},
    {"c1", "8"},
    {"c2", "100K"},
    {"e0", "0MPa"},
    {"eg", "1e15Pa"},
    {"tau", "1us"},
    {"alpha", "0.4"},
    {"layer-thickness", "1um"}, /* These two belong together. */
    {"modulus-ratio", "1"},
    {"mass-loss", "3mg"}, /* These two belong together, too. */
    {"density", "1150kg/m^3"},
};

static const char *good_text(const char *name, const char *tried)
{
    if (strcmp(tried, "observed-thickness") == 0 && strcmp(name, "critical-energy") == 0)
        return NULL;
    for (size_t i = 0; i < sizeof good / sizeof good[0]; i++)
        if (strcmp(good[i].name, name) == 0)
            return good[i].text;
    return NULL;
}

/* Value in a section of a case: the alternative in one section is the subject of another. */
static const char *good_in(const char *section, const char *name, const char *tried)
{
    return strcmp(section, "identify") == 0 && strcmp(name, "observed-thickness") == 0
               ? "1um"
               : good_text(name, tried);
}

/* ---- as an option ---------------------------------------------------------------------------- */

/* Every accepted call fails because its files do not exist. */
static const struct {
    const char *name, *files;
    const wt_params *(*params[7])(void);
} subcommands[] = {
    {"info", "absent", {wt_read_params}},
    {"convert", "absent", {wt_convert_job_params}},
    {"indent", "absent", {wt_indent_job_params}},
    {"compare", "--master absent absent absent", {wt_compare_job_params}},
    {"master", "absent", {wt_master_options_params}},
    {"friction",
     "--material absent --roughness absent --strain-softening absent",
     {wt_sliding_params, wt_layer_observation_params, wt_job_params}},
    {"layer",
     "--material absent --roughness absent --strain-softening absent",
     {wt_sliding_params, wt_layer_job_params, wt_job_params}},
    {"run", "absent", {wt_run_params}},
};

/* Options of friction without an effect on the energy of a layer. */
static bool is_of_friction(const char *name)
{
    static const char *const names[] = {"decades"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (strcmp(names[i], name) == 0)
            return true;
    return false;
}

static bool is_option(size_t s, const wt_param *p)
{
    return (p->flags & PARAM_NO_OPTION) == 0 &&
           !(strcmp(subcommands[s].name, "layer") == 0 && is_of_friction(p->name));
}

static bool is_refused_option(size_t s, const char *name, const char *text)
{
    char command[TEXT], words[TEXT] = "", option[80];
    size_t used = (size_t)snprintf(command, sizeof command, "%s %s %s", WT_PROGRAM,
                                   subcommands[s].name, subcommands[s].files);
    for (size_t t = 0; subcommands[s].params[t] != NULL; t++) {
        const wt_params *params = subcommands[s].params[t]();
        for (size_t i = 0; i < wt_params_count(params); i++) {
            const wt_param *p = wt_params_get(params, i);
            const char *value = good_text(p->name, name);
            if (value != NULL && is_option(s, p))
                used += (size_t)snprintf(command + used, sizeof command - used, " --%s '%s'",
                                         p->name, value);
        }
    }
    drop_option(command, name);
    used = strlen(command);
    snprintf(command + used, sizeof command - used, " --%s '%s' 2>&1 >/dev/null", name, text);
    FILE *out = popen(command, "r");
    assert_non_null(out);
    words[fread(words, 1, sizeof words - 1, out)] = '\0';
    const int status = WEXITSTATUS(pclose(out));
    snprintf(option, sizeof option, "--%s: ", name);
    const bool refused = status == 2 && strstr(words, option) != NULL;
    if (!refused && status != 1)
        fail_msg("%s: %d, %s", command, status, words);
    return refused;
}

/* ---- in a case ------------------------------------------------------------------------------- */

static const struct {
    const char *section, *before, *after;
} frames[] = {
    {"dma", "<dma>", "<files>x</files></dma>"},
    {"fractional-zener", "<dma><fractional-zener>", "</fractional-zener></dma>"},
    {"transverse", "<dma><files>x</files><transverse>", "</transverse></dma>"},
    {"wlf",
     "<dma><reference-temperature>20degC</reference-temperature><prony deformation='tension'>"
     "<equilibrium>1MPa</equilibrium><term time='1s' modulus='1MPa'/></prony><wlf>",
     "</wlf></dma>"},
    {"self-affine", "<roughness><self-affine>", "</self-affine></roughness>"},
    {"sliding", "<sliding><strain-softening><file>x</file></strain-softening>", "</sliding>"},
    {"spectrum", "<roughness><spectrum><file>x</file>", "</spectrum></roughness>"},
    {"record", "<record>", "<files>x</files></record>"},
    {"measured", "<roughness>", "<files>x</files></roughness>"},
};

static bool is_refused_in_case(size_t s, const wt_param *tried, const char *text)
{
    const char *section = case_sections[s].name;
    char before[512], after[64], xml[TEXT];
    snprintf(before, sizeof before, "<%s>", section);
    snprintf(after, sizeof after, "</%s>", section);
    for (size_t i = 0; i < sizeof frames / sizeof frames[0]; i++)
        if (strcmp(frames[i].section, section) == 0) {
            snprintf(before, sizeof before, "%s", frames[i].before);
            snprintf(after, sizeof after, "%s", frames[i].after);
        }
    size_t used = (size_t)snprintf(xml, sizeof xml, "<case version='1'>%s", before);
    for (size_t t = 0; t < SECTION_TABLES && case_sections[s].params[t] != NULL; t++) {
        const wt_params *params = case_sections[s].params[t]();
        for (size_t i = 0; i < wt_params_count(params); i++) {
            const wt_param *p = wt_params_get(params, i);
            const char *name = case_param_name(section, p->name);
            const char *value = p == tried ? text : good_in(section, p->name, tried->name);
            if (value != NULL && (p->flags & PARAM_NO_CASE) == 0)
                used += (size_t)snprintf(xml + used, sizeof xml - used, "<%s>%s</%s>", name, value,
                                         name);
        }
    }
    snprintf(xml + used, sizeof xml - used, "%s</case>", after);
    wt_case *c = NULL;
    wt_error err = WT_ERROR_INIT;
    const wt_status status = case_from_bytes(xml, strlen(xml), "folder/case.xml", &c, &err);
    wt_case_free(c);
    if (status != WT_OK && strstr(err.place, "line") == NULL)
        fail_msg("%s: %s: %s", xml, err.place, err.message);
    return status != WT_OK;
}

/* ---- from C ---------------------------------------------------------------------------------- */

static wt_status call_read(const void *structure, wt_error *err)
{
    wt_formats *formats = NULL;
    wt_input *input = NULL;
    wt_force_source *source = NULL;
    assert_int_equal(wt_formats_new(NULL, &formats, NULL, NULL), WT_OK);
    assert_int_equal(wt_input_open_memory("x", 1, "x", &input, NULL), WT_OK);
    const wt_status status = wt_force_open(formats, input, structure, NULL, &source, err);
    wt_force_close(source);
    wt_input_close(input);
    wt_formats_free(formats);
    return status;
}

static wt_status call_indent_options(const void *structure, wt_error *err)
{
    const double x[] = {0, 1e-9, 2e-9};
    const wt_tip tip = {.shape = WT_TIP_PARABOLOID, .radius = 1e-6};
    wt_contact_table *table = NULL;
    wt_indent_workspace *workspace = wt_indent_workspace_new();
    wt_indent_fit fit;
    assert_int_equal(wt_contact_table_new(&tip, 1e-10, 1e-6, &table, NULL), WT_OK);
    const wt_status status =
        wt_indent_fit_curve(table, structure, x, x, NULL, 3, 1, workspace, &fit, err);
    wt_indent_workspace_free(workspace);
    wt_contact_table_free(table);
    return status;
}

static wt_status call_shift(const void *structure, wt_error *err)
{
    const wt_sweep sweep = {.n_isotherms = 0};
    wt_master master = {.n = 0};
    return wt_master_fit(&sweep, structure, NULL, &master, err);
}

static wt_status call_friction_options(const void *structure, wt_error *err)
{
    double time = 1, modulus = 1e6;
    const wt_prony prony = {.deformation = WT_TENSION,
                            .reference_temperature = 293,
                            .equilibrium_modulus = 1e6,
                            .n = 1,
                            .relaxation_time = &time,
                            .modulus = &modulus,
                            .frequency_min = (double)NAN,
                            .frequency_max = (double)NAN};
    wt_material *material = NULL;
    wt_roughness *roughness = NULL;
    wt_friction_workspace *workspace = NULL;
    assert_int_equal(wt_material_prony(&prony, 0.5, &material, NULL), WT_OK);
    assert_int_equal(wt_roughness_self_affine(1e3, 1e3, 1e6, 0.8, 1e-17, &roughness, NULL), WT_OK);
    const wt_status status =
        wt_friction_workspace_new(material, roughness, structure, &workspace, err);
    wt_friction_workspace_free(workspace);
    wt_roughness_free(roughness);
    wt_material_free(material);
    return status;
}

static wt_status call_layer_parameters(const void *structure, wt_error *err)
{
    double wavenumber = 1e6, power = 1e5;
    const wt_energy_source source = {.n = 1, .wavenumber = &wavenumber, .power = &power};
    wt_layer_steady_state balance;
    return wt_layer_steady_state_compute(&source, structure, &balance, err);
}

static wt_status call_job(const void *structure, wt_error *err)
{
    wt_indent_job job = wt_indent_job_defaults();
    wt_indent_tables tables = {0};
    job.tip = (wt_tip){.shape = WT_TIP_PARABOLOID, .radius = 1e-6};
    return wt_indent_group(&job, structure, &tables, err);
}

static wt_status call_master(const void *structure, wt_error *err)
{
    const wt_job job = wt_job_defaults();
    return wt_master_compute(structure, &job, NULL, NULL, err);
}

static wt_status call_compare(const void *structure, wt_error *err)
{
    const wt_job work = wt_job_defaults();
    wt_compare_tables tables = {0};
    wt_compare_job job = *(const wt_compare_job *)structure;
    wt_table *table = wt_table_new("indentation/bulk", "");
    job.bulk = table;
    const wt_status status = wt_compare_groups(&job, &work, &tables, err);
    wt_tables_clear(&tables, sizeof tables);
    wt_table_free(table);
    return status;
}

/* A rubber and a surface without data, so that no call gets far. */
static wt_rubber no_rubber;
static wt_surface no_surface;
static const double velocity[] = {1};

static wt_sliding sliding_on_nothing(wt_sliding s)
{
    s.rubber = &no_rubber;
    s.surface = &no_surface;
    return s;
}

static wt_sliding good_sliding(void)
{
    wt_sliding s = sliding_on_nothing(wt_sliding_defaults());
    s.pressure.value = 1e6;
    s.velocity = velocity;
    s.n_velocity = 1;
    return s;
}

static wt_status call_sliding(const void *structure, wt_error *err)
{
    const wt_job job = wt_job_defaults();
    const wt_sliding s = sliding_on_nothing(*(const wt_sliding *)structure);
    wt_friction_tables tables = {0};
    return wt_sliding_friction_compute(&s, NULL, &job, &tables, err);
}

static wt_status call_layer_known(const void *structure, wt_error *err)
{
    const wt_job job = wt_job_defaults();
    const wt_sliding s = good_sliding();
    wt_friction_tables tables = {0};
    return wt_sliding_friction_compute(&s, structure, &job, &tables, err);
}

static wt_status call_layer(const void *structure, wt_error *err)
{
    const wt_job job = wt_job_defaults();
    const wt_sliding s = good_sliding();
    wt_layer_tables tables = {0};
    return wt_layer_thickness_compute(&s, structure, &job, &tables, err);
}

static wt_status call_run(const void *structure, wt_error *err)
{
    static const char xml[] = "<case version='1'/>";
    wt_case *c = NULL;
    wt_result *result = NULL;
    assert_int_equal(case_from_bytes(xml, strlen(xml), "x.xml", &c, NULL), WT_OK);
    const wt_status status = wt_run_case(c, structure, NULL, &result, NULL, err);
    wt_result_free(result);
    wt_case_free(c);
    return status;
}

static const struct {
    const wt_params *(*params)(void);
    wt_status (*call)(const void *structure, wt_error *err);
} calls[] = {
    {wt_read_params, call_read},
    {wt_indent_params, call_indent_options},
    {wt_master_options_params, call_shift},
    {wt_friction_params, call_friction_options},
    {wt_layer_params, call_layer_parameters},
    {wt_job_params, call_job},
    {wt_master_job_params, call_master},
    {wt_compare_job_params, call_compare},
    {wt_sliding_params, call_sliding},
    {wt_layer_observation_params, call_layer_known},
    {wt_layer_job_params, call_layer},
    {wt_run_params, call_run},
};

/* Returns true if a call refuses the structure because of this parameter. */
static bool is_refused_call(size_t k, const wt_param *p, double value)
{
    alignas(max_align_t) unsigned char structure[PARAM_STRUCTURE_SIZE_MAX] = {0};
    const wt_params *params = calls[k].params();
    uint64_t given = 0;
    wt_error err = WT_ERROR_INIT;
    params->defaults(structure);
    for (size_t i = 0; i < params->n_records; i++) {
        const char *text = good_text(params->records[i].name, p->name);
        if (text != NULL)
            assert_int_equal(
                wt_params_set(params, params->records[i].name, structure, text, &given, NULL),
                WT_OK);
    }
    const double *list = &value;
    const size_t one = 1;
    const unsigned narrow = value > 0 && value < UINT_MAX ? (unsigned)value : 0;
    const uint64_t wide = narrow;
    unsigned char old[sizeof(wt_estimate)];
    memcpy(old, structure + p->offset, p->size);
    if (p->kind == PARAM_LIST) {
        memcpy(structure + p->offset, &list, sizeof list);
        memcpy(structure + p->count_offset, &one, sizeof one);
    } else if (p->kind == PARAM_COUNT && p->size == sizeof wide) {
        memcpy(structure + p->offset, &wide, sizeof wide);
    } else if (p->kind == PARAM_COUNT) {
        memcpy(structure + p->offset, &narrow, sizeof narrow);
    } else {
        memcpy(structure + p->offset, &value, sizeof value);
    }
    const wt_status status = calls[k].call(structure, &err);
    /* Restores the pointers, so that lists can be freed. */
    memcpy(structure + p->offset, old, p->size);
    wt_params_clear(params, structure, &given);
    if (status == WT_OK)
        return false;
    /* An infinite thickness has a different message. */
    return (strcmp(err.place, p->name) == 0 || isinf(value)) &&
           (status == WT_E_RANGE || status == WT_E_MISSING);
}

/* ---- comparison of the interfaces ------------------------------------------------------------ */

static bool is_number(const wt_param *p)
{
    return p->kind == PARAM_NUMBER || p->kind == PARAM_ESTIMATE || p->kind == PARAM_LIST ||
           p->kind == PARAM_COUNT;
}

static size_t wrong;

static void complain(const char *format, ...) WT_PRINTF(1, 2);
static void complain(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vfprintf(stderr, format, arguments);
    va_end(arguments);
    fputc('\n', stderr);
    wrong++;
}

/* Tries one value in each interface: `text` as an option and in a case, `value` in C. `in_c` is the
 * expected result in C. */
static void try_value(const wt_param *p, const char *text, bool refused, double value, int in_c)
{
    for (size_t s = 0; s < sizeof subcommands / sizeof subcommands[0]; s++)
        for (size_t t = 0; subcommands[s].params[t] != NULL; t++)
            for (size_t i = 0; i < wt_params_count(subcommands[s].params[t]()); i++)
                if (wt_params_get(subcommands[s].params[t](), i) == p && is_option(s, p) &&
                    is_refused_option(s, p->name, text) != refused)
                    complain("weartrack %s --%s '%s' is %s", subcommands[s].name, p->name, text,
                             refused ? "taken" : "refused");
    for (size_t s = 0; s < N_CASE_SECTIONS; s++)
        for (size_t t = 0; t < SECTION_TABLES && case_sections[s].params[t] != NULL; t++)
            for (size_t i = 0; i < wt_params_count(case_sections[s].params[t]()); i++)
                if (wt_params_get(case_sections[s].params[t](), i) == p &&
                    (p->flags & PARAM_NO_CASE) == 0 && is_refused_in_case(s, p, text) != refused)
                    complain("'%s' for %s in <%s> of a case is %s", text, p->name,
                             case_sections[s].name, refused ? "taken" : "refused");
    for (size_t k = 0; k < sizeof calls / sizeof calls[0] && in_c >= 0; k++) {
        const wt_params *params = calls[k].params();
        if (p >= params->records && p < params->records + params->n_records &&
            is_refused_call(k, p, value) != in_c)
            complain("%s = %g of a call from C is %s", p->name, value, in_c ? "taken" : "refused");
    }
}

static void try_number(const wt_param *p, double value, bool refused)
{
    char text[128];
    const char *unit = wt_quantity_unit(p->quantity);
    snprintf(text, sizeof text, "%.17g%s", value, strcmp(unit, "1") == 0 ? "" : unit);
    /* A count is unsigned in C. */
    try_value(p, text, refused, value, p->kind == PARAM_COUNT && value < 0 ? -1 : refused);
}

static void try_param(const wt_param *p)
{
    const param_limits *l = &p->limits;
    const bool whole = p->kind == PARAM_COUNT;
    if (isfinite(l->low)) {
        try_number(p, l->low, !l->with_low);
        try_number(p, l->low - (whole ? 1 : 1e-6 * fabs(l->low) + 1e-12), true);
    }
    if (isfinite(l->high)) {
        try_number(p, l->high, !l->with_high);
        try_number(p, l->high + (whole ? 1 : 1e-6 * fabs(l->high)), true);
    } else if (!whole) { /* The limit is the plausible maximum of the quantity. */
        if (strcmp(p->name, "q0") != 0 && strcmp(p->name, "qr") != 0) /* they must be below q1 */
            try_number(p, quantity_plausible_maximum(p->quantity), false);
        try_number(p, 1.000001 * quantity_plausible_maximum(p->quantity), true);
        try_number(p, 1e300, true);
    }
    try_value(p, "nan", true, (double)NAN, whole ? -1 : p->unset == NULL || p->kind == PARAM_LIST);
    try_value(p, "inf", true, (double)INFINITY, whole ? -1 : 1);
    try_value(p, "", true, 0, -1);
    try_value(p, "1cd", true, 0, -1); /* unit of no quantity */
    if (p->kind == PARAM_NUMBER || whole)
        try_value(p, "0.3 +- 0.1", true, 0, -1); /* an error without use, or no unit */
}

static void test_numbers(void **state)
{
    (void)state;
    const wt_param *tried[512];
    size_t n = 0;
    for (size_t k = 0; k < sizeof calls / sizeof calls[0]; k++)
        for (size_t i = 0; i < calls[k].params()->n_records; i++)
            if (is_number(&calls[k].params()->records[i]))
                tried[n++] = &calls[k].params()->records[i];
    for (size_t s = 0; s < N_CASE_SECTIONS; s++)
        for (size_t t = 0; t < SECTION_TABLES && case_sections[s].params[t] != NULL; t++)
            for (size_t i = 0; i < wt_params_count(case_sections[s].params[t]()); i++) {
                const wt_param *p = wt_params_get(case_sections[s].params[t](), i);
                bool known = !is_number(p);
                for (size_t k = 0; k < n; k++)
                    known = known || tried[k] == p;
                if (!known)
                    tried[n++] = p;
            }
    assert_in_range(n, 40, 512);
    wrong = 0;
    for (size_t i = 0; i < n; i++)
        try_param(tried[i]);
    assert_int_equal(wrong, 0);
}

/* Words and switches. */
static void test_words(void **state)
{
    (void)state;
    wrong = 0;
    for (size_t s = 0; s < N_CASE_SECTIONS; s++)
        for (size_t t = 0; t < SECTION_TABLES && case_sections[s].params[t] != NULL; t++)
            for (size_t i = 0; i < wt_params_count(case_sections[s].params[t]()); i++) {
                const wt_param *p = wt_params_get(case_sections[s].params[t](), i);
                char word[64];
                if (is_number(p) || (p->flags & PARAM_NO_CASE) != 0)
                    continue;
                if (p->kind == PARAM_FLAG) { /* option without a value */
                    assert_true(is_refused_in_case(s, p, "maybe"));
                    assert_false(is_refused_in_case(s, p, "yes"));
                    assert_false(is_refused_in_case(s, p, "no"));
                    continue;
                }
                try_value(p, "neither", true, 0, -1);
                try_value(p, "", true, 0, -1);
                for (const char *w = p->kind == PARAM_CHOICE ? p->value : ""; *w != '\0';
                     w += strspn(w, "|")) {
                    snprintf(word, sizeof word, "%.*s", (int)strcspn(w, "|"), w);
                    try_value(p, word, false, 0, -1);
                    w += strcspn(w, "|");
                }
            }
    assert_int_equal(wrong, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_numbers),
        cmocka_unit_test(test_words),
    };
    return cmocka_run_group_tests_name("one answer", tests, NULL, NULL);
}
