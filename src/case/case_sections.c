/* Reads the nodes of a case file (parameters, text and file sets) and its sections with their
 * nested elements. SPDX-License-Identifier: GPL-3.0-or-later */
#include "case/case_node.h"

#include "core/base/array.h"
#include "core/base/memory.h"
#include "core/base/param.h"
#include "core/base/shared_params.h"
#include "core/table/table.h"
#include "dma/rubber.h"
#include "friction/counter_surface.h"
#include "indentation/indent.h"
#include "job/inputs.h"
#include "record/record.h"
#include "report/report_files.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- nodes ----------------------------------------------------------------------------------- */

static bool is_element_named(const xmlNode *node, const char *name)
{
    return node->type == XML_ELEMENT_NODE && strcmp((const char *)node->name, name) == 0;
}

xmlNode *case_child(const xmlNode *parent, const char *name)
{
    for (xmlNode *node = parent->children; node != NULL; node = node->next)
        if (is_element_named(node, name))
            return node;
    return NULL;
}

/* Returns the next sibling element with the name, NULL if there is none. */
static xmlNode *case_next(const xmlNode *node, const char *name)
{
    for (xmlNode *next = node->next; next != NULL; next = next->next)
        if (is_element_named(next, name))
            return next;
    return NULL;
}

/* Adds "line N, <name>" to an error and returns `status`. */
static wt_status case_add_location(const xmlNode *node, wt_status status, wt_error *err)
{
    wt_error_place(err, "line %ld, <%s>", xmlGetLineNo(node), (const char *)node->name);
    return status;
}

const char *case_param_name(const char *section, const char *param)
{
    const size_t n = strlen(section);
    return strncmp(param, section, n) == 0 && param[n] == '-' ? param + n + 1 : param;
}

/* Variant for an error whose place is the name of a parameter in this section. */
static wt_status case_add_param_location(const xmlNode *section, wt_status status, wt_error *err)
{
    if (status == WT_OK)
        return WT_OK;
    const char *param = err != NULL ? err->place : "";
    const xmlNode *node = case_child(section, case_param_name((const char *)section->name, param));
    return case_add_location(node != NULL ? node : section, status, err);
}

/* Copies `raw` without surrounding blanks into the memory of the case. Frees `raw`. */
static const char *store_text(wt_case *c, xmlChar *raw)
{
    static const char blanks[] = " \t\r\n";
    if (raw == NULL) /* libxml2 had no memory; it does not tell the size */
        out_of_memory(0);
    const char *begin = (const char *)raw + strspn((const char *)raw, blanks);
    size_t length = strlen(begin);
    while (length > 0 && strchr(blanks, begin[length - 1]) != NULL)
        length--;
    const char *const copy = arena_text(&c->memory, begin, length);
    xmlFree(raw);
    return copy;
}

const char *case_node_text(wt_case *c, const xmlNode *node)
{
    return store_text(c, xmlNodeGetContent(node));
}

static wt_status read_attribute(wt_case *c, const xmlNode *section, const char *param,
                                const char *name, case_setting *setting, wt_error *err)
{
    const char *const text = store_text(c, xmlGetProp(section, (const xmlChar *)name));
    const wt_status status =
        wt_params_set(setting->params, param, setting->structure, text, &setting->given, err);
    if (status != WT_OK)
        wt_error_place(err, "line %ld, attribute %s of <%s>", xmlGetLineNo(section), name,
                       (const char *)section->name);
    return status;
}

/* Reads every element with the name; the schema allows a repetition only for lists. */
static wt_status read_param(wt_case *c, const xmlNode *section, const char *param,
                            case_setting *setting, wt_error *err)
{
    const char *const name = case_param_name((const char *)section->name, param);
    const xmlNode *node = case_child(section, name);
    if (node == NULL && xmlHasProp(section, (const xmlChar *)name) != NULL)
        return read_attribute(c, section, param, name, setting, err);
    for (; node != NULL; node = case_next(node, name)) {
        const wt_status status = wt_params_set(setting->params, param, setting->structure,
                                               case_node_text(c, node), &setting->given, err);
        if (status != WT_OK)
            return case_add_location(node, status, err);
    }
    return WT_OK;
}

/* Sets every parameter that the section states as an element or an attribute. The structure must
 * live as long as the case. */
static wt_status case_read_params(wt_case *c, const xmlNode *section, const wt_params *params,
                                  void *structure, wt_error *err)
{
    case_setting *setting = arena_alloc(&c->memory, 1, sizeof *setting);
    *setting = (case_setting){params, structure, 0, c->settings};
    c->settings = setting;
    wt_status status = WT_OK;
    for (size_t i = 0; status == WT_OK && i < wt_params_count(params); i++) {
        const wt_param *param = wt_params_get(params, i);
        if ((param->flags & PARAM_NO_CASE) == 0)
            status = read_param(c, section, param->name, setting, err);
    }
    return status;
}

/* ---- file sets ------------------------------------------------------------------------------- */

static case_files case_files_defaults(void)
{
    return (case_files){.spring_constant = {(double)NAN, 0, 0, "N/m"},
                        .sensitivity = {(double)NAN, 0, 0, "m/V"}};
}

static const wt_param rows[] = {SPRING_CONSTANT(case_files, PARAM_NO_OPTION, indent_error_check),
                                SENSITIVITY(case_files, PARAM_NO_OPTION, indent_error_check)};

PARAM_TABLE(case_group_params, case_files, rows, case_files_defaults, NO_PARTS)

/* The attributes of a node override the values that `set` and `cantilever` have already. */
static wt_status read_attributes(wt_case *c, const xmlNode *node, wt_file_set *set,
                                 case_files *cantilever, wt_error *err)
{
    case_files *stated = arena_alloc(&c->memory, 1, sizeof *stated);
    *stated = *cantilever;
    wt_status status = case_read_params(c, node, case_group_params(), stated, err);
    if (status == WT_OK)
        status = case_read_params(c, node, wt_file_set_params(), set, err);
    *cantilever = *stated;
    set->read.spring_constant = cantilever->spring_constant.value;
    set->read.sensitivity = cantilever->sensitivity.value;
    return status;
}

static bool is_same_value(double a, double b)
{
    return !(a < b) && !(a > b) && !isnan(a) && !isnan(b);
}

/* Combines the values of all files of a group. The value is NaN if the files differ; the relative
 * error is the largest one, NaN if a file states none. */
static void merge_file_estimate(wt_estimate *group, double *error, wt_estimate of_file, bool first)
{
    const double relative = of_file.standard_error / of_file.value;
    if (first) {
        *group = of_file;
        *error = relative > 0 ? relative : (double)NAN;
        return;
    }
    *error = relative > 0 && !isnan(*error) ? fmax(*error, relative) : (double)NAN;
    if (is_same_value(group->value, of_file.value))
        group->standard_error = fmax(group->standard_error, of_file.standard_error);
    else
        group->value = (double)NAN;
}

/* Reads the <NAME> elements of a parent as file sets. The attributes of the parent are defaults. */
static wt_status case_read_files(wt_case *c, const xmlNode *parent, const char *name,
                                 case_files *files, wt_error *err)
{
    size_t n = 0;
    for (const xmlNode *node = case_child(parent, name); node != NULL; node = case_next(node, name))
        n++;
    wt_file_set *common = arena_alloc(&c->memory, 1, sizeof *common);
    const char **patterns = arena_alloc(&c->memory, n, sizeof *patterns);
    files->sets = arena_alloc(&c->memory, n, sizeof *files->sets);
    *common = (wt_file_set){.folder = c->folder, .read = wt_read_defaults()};
    case_files group = case_files_defaults();
    wt_status status = read_attributes(c, parent, common, &group, err);
    files->n = n;
    files->next = c->roles;
    c->roles = files;
    const xmlNode *node = case_child(parent, name);
    for (size_t i = 0; status == WT_OK && i < n; i++, node = case_next(node, name)) {
        wt_file_set *set = &files->sets[i];
        case_files cantilever = group;
        *set = *common;
        status = read_attributes(c, node, set, &cantilever, err);
        patterns[i] = case_node_text(c, node);
        set->patterns = &patterns[i];
        set->n_patterns = 1;
        merge_file_estimate(&files->spring_constant, &files->lever_error,
                            cantilever.spring_constant, i == 0);
        merge_file_estimate(&files->sensitivity, &files->sensitivity_error, cantilever.sensitivity,
                            i == 0);
    }
    return status;
}

/* ---- indentation ----------------------------------------------------------------------------- */

static wt_status read_group_files(wt_case *c, const xmlNode *section, const char *name,
                                  case_files *files, wt_error *err)
{
    const xmlNode *group = case_child(section, name);
    return group == NULL ? WT_OK : case_read_files(c, group, "files", files, err);
}

static wt_status check_disjoint(const wt_case *c, const xmlNode *section, wt_error *err)
{
    for (size_t i = 0; i < c->bulk.n; i++)
        for (size_t j = 0; j < c->track.n; j++)
            if (strcmp(c->bulk.sets[i].patterns[0], c->track.sets[j].patterns[0]) == 0) {
                wt_fail(err, WT_E_ARG, "the same files are bulk and wear track");
                wt_error_found(err, "\"%s\" in both", c->bulk.sets[i].patterns[0]);
                return case_add_location(case_child(section, "track"), WT_E_ARG, err);
            }
    return WT_OK;
}

/* The path of the file with manual overrides is relative to the case. */
static void read_choices_path(wt_case *c, const xmlNode *section)
{
    const xmlNode *node = case_child(section, "overrides");
    if (node == NULL)
        return;
    char *path = wt_path_join(c->folder, case_node_text(c, node));
    c->indent.choices = arena_text(&c->memory, path, strlen(path));
    free(path);
}

wt_status case_read_indentation(wt_case *c, const xmlNode *section, wt_error *err)
{
    wt_status status = case_read_params(c, section, wt_indent_job_params(), &c->indent, err);
    if (status == WT_OK)
        read_choices_path(c, section);
    if (status == WT_OK)
        status = case_read_params(c, section, wt_compare_job_params(), &c->compare, err);
    if (status == WT_OK)
        status = read_group_files(c, section, "bulk", &c->bulk, err);
    if (status == WT_OK)
        status = read_group_files(c, section, "track", &c->track, err);
    return status == WT_OK ? check_disjoint(c, section, err) : status;
}

/* ---- dma ------------------------------------------------------------------------------------- */

static wt_prony prony_case_defaults(void)
{
    return (wt_prony){.frequency_min = (double)NAN, .frequency_max = (double)NAN};
}

static const wt_param prony_rows[] = {
    {PARAM_CHOICE_OF("deformation", wt_prony, deformation, "tension|shear"),
     .flags = PARAM_REQUIRED | PARAM_NO_OPTION, .help = "how the moduli are meant"},
    {PARAM("equilibrium", wt_prony, equilibrium_modulus, WT_Q_MODULUS, AT_LEAST(0)),
     .flags = PARAM_REQUIRED | PARAM_NO_OPTION, .help = "modulus after a long time"},
    {PARAM("frequency-min", wt_prony, frequency_min, WT_Q_ANGULAR_FREQUENCY, ABOVE(0)), .unset = "",
     .flags = PARAM_NO_OPTION, .help = "where measurement begins to back it"},
    {PARAM("frequency-max", wt_prony, frequency_max, WT_Q_ANGULAR_FREQUENCY, ABOVE(0)), .unset = "",
     .flags = PARAM_NO_OPTION, .help = "where measurement ceases to back it"},
};
PARAM_TABLE(case_prony_params, wt_prony, prony_rows, prony_case_defaults, NO_PARTS)

typedef struct term {
    double time, modulus;
} term;

static term term_case_defaults(void)
{
    return (term){(double)NAN, (double)NAN};
}

static const wt_param term_rows[] = {
    {PARAM("time", term, time, WT_Q_TIME, ABOVE(0)), .flags = PARAM_REQUIRED | PARAM_NO_OPTION,
     .help = "relaxation time"},
    {PARAM("modulus", term, modulus, WT_Q_MODULUS, AT_LEAST(0)),
     .flags = PARAM_REQUIRED | PARAM_NO_OPTION, .help = "of the term"},
};
PARAM_TABLE(case_term_params, term, term_rows, term_case_defaults, NO_PARTS)

static case_wlf wlf_case_defaults(void)
{
    return (case_wlf){.c1 = {(double)NAN, 0, 0, "1"}, .c2 = {(double)NAN, 0, 0, "K"}};
}

static const wt_param wlf_rows[] = {
    {PARAM("c1", case_wlf, c1, WT_Q_NONE, ABOVE(0)), .flags = PARAM_REQUIRED | PARAM_NO_OPTION,
     .help = "first constant"},
    {PARAM("c2", case_wlf, c2, WT_Q_TEMPERATURE_DIFFERENCE, ABOVE(0)),
     .flags = PARAM_REQUIRED | PARAM_NO_OPTION, .help = "second constant"},
};
PARAM_TABLE(case_wlf_params, case_wlf, wlf_rows, wlf_case_defaults, NO_PARTS)

static wt_status read_terms(wt_case *c, const xmlNode *node, wt_error *err)
{
    wt_prony *p = &c->prony;
    *p = prony_case_defaults();
    wt_status status = case_read_params(c, node, case_prony_params(), p, err);
    size_t n = 0;
    for (const xmlNode *t = case_child(node, "term"); t != NULL; t = case_next(t, "term"))
        n++;
    term *terms = arena_alloc(&c->memory, n, sizeof *terms);
    p->relaxation_time = arena_alloc(&c->memory, n, sizeof *p->relaxation_time);
    p->modulus = arena_alloc(&c->memory, n, sizeof *p->modulus);
    for (const xmlNode *t = case_child(node, "term"); status == WT_OK && t != NULL;
         t = case_next(t, "term")) {
        status = case_read_params(c, t, case_term_params(), &terms[p->n], err);
        p->relaxation_time[p->n] = terms[p->n].time;
        p->modulus[p->n] = terms[p->n].modulus;
        p->n++;
    }
    c->has_material = status == WT_OK;
    return status;
}

static wt_status read_material_table(wt_case *c, const xmlNode *section, wt_error *err)
{
    c->kind = WT_RUBBER_TABLE;
    c->has_material = true;
    return case_read_files(c, section, "table", &c->points, err);
}

static wt_status read_zener(wt_case *c, const xmlNode *node, wt_error *err)
{
    wt_rubber rubber = {0};
    c->kind = WT_RUBBER_ZENER;
    c->has_material = true;
    wt_status status = case_read_params(c, node, flow_zener_params(), &c->zener, err);
    if (status == WT_OK) {
        status = flow_rubber_zener(&c->zener, c->master.poisson_ratio, &rubber, err);
        if (status != WT_OK)
            case_add_location(node, status, err);
        wt_rubber_clear(&rubber);
    }
    return status;
}

static wt_status read_wlf(wt_case *c, const xmlNode *node, wt_error *err)
{
    wt_status status = case_read_params(c, node, case_wlf_params(), &c->wlf, err);
    if (status == WT_OK && isnan(c->master.fit.reference_temperature)) {
        wt_fail(err, WT_E_MISSING, "WLF constants mean nothing without their temperature");
        wt_error_expected(err, "<reference-temperature> in <dma>");
        return case_add_location(node, WT_E_MISSING, err);
    }
    c->has_wlf = status == WT_OK;
    return status;
}

wt_status case_read_dma(wt_case *c, const xmlNode *section, wt_error *err)
{
    const xmlNode *prony = case_child(section, "prony"), *wlf = case_child(section, "wlf"),
                  *zener = case_child(section, "fractional-zener"),
                  *transverse = case_child(section, "transverse");
    wt_status status = case_read_params(c, section, wt_master_job_params(), &c->master, err);
    if (status == WT_OK)
        status = case_read_params(c, section, wt_reduction_params(), &c->master.reduction, err);
    if (status == WT_OK)
        status = case_read_params(c, section, wt_ramp_job_params(), &c->ramp, err);
    if (status == WT_OK && prony != NULL)
        status = read_terms(c, prony, err);
    if (status == WT_OK && case_child(section, "table") != NULL)
        status = read_material_table(c, section, err);
    if (status == WT_OK && zener != NULL)
        status = read_zener(c, zener, err);
    if (status == WT_OK && wlf != NULL)
        status = read_wlf(c, wlf, err);
    if (status == WT_OK && !c->has_material)
        status = case_read_files(c, section, "files", &c->dma, err);
    c->is_transverse = transverse != NULL;
    if (status == WT_OK && transverse != NULL)
        status = case_read_params(c, transverse, wt_transverse_params(), &c->transverse, err);
    return status;
}

/* ---- roughness, sliding, layer --------------------------------------------------------------- */

static wt_status read_height_map_files(wt_case *c, const xmlNode *section, wt_error *err)
{
    wt_status status = case_read_files(c, section, "files", &c->height_maps, err);
    if (status == WT_OK)
        status = case_read_params(c, section, wt_topography_job_params(), &c->topography, err);
    c->topography.sets = c->height_maps.sets;
    c->topography.n_sets = c->height_maps.n;
    return status;
}

wt_status case_read_roughness(wt_case *c, const xmlNode *section, wt_error *err)
{
    const xmlNode *law = case_child(section, "self-affine");
    const xmlNode *spectrum = case_child(section, "spectrum");
    wt_status status = WT_OK;
    if (law != NULL) {
        c->has_self_affine = c->surface.self_affine = true;
        status = case_read_params(c, law, flow_self_affine_params(), &c->surface, err);
        if (status == WT_OK && (status = flow_surface_check(&c->surface, err)) != WT_OK)
            case_add_location(law, status, err);
        return status;
    }
    if (spectrum == NULL)
        return read_height_map_files(c, section, err);
    c->has_spectrum = true;
    c->surface.c0 = (wt_estimate){1, 0, 0, "1"};
    status = case_read_files(c, spectrum, "file", &c->spectrum, err);
    if (status == WT_OK)
        status = case_read_params(c, spectrum, flow_spectrum_params(), &c->surface, err);
    return status;
}

wt_status case_read_sliding(wt_case *c, const xmlNode *section, wt_error *err)
{
    const xmlNode *softening = case_child(section, "strain-softening");
    c->has_sliding = true;
    c->softens = softening != NULL;
    wt_status status = case_read_params(c, section, wt_sliding_params(), &c->sliding, err);
    if (status == WT_OK && softening != NULL && case_child(softening, "file") != NULL)
        status = case_read_files(c, softening, "file", &c->softening, err);
    return status;
}

wt_status case_read_layer(wt_case *c, const xmlNode *section, wt_error *err)
{
    const xmlNode *ratio = case_child(section, "modulus-ratio");
    c->has_layer = true;
    c->has_modulus_ratio = ratio != NULL;
    wt_status status = case_read_params(c, section, wt_layer_job_params(), &c->layer, err);
    if (status == WT_OK)
        status =
            case_read_params(c, section, wt_layer_observation_params(), &c->layer_observation, err);
    wt_layer_job checked = c->layer;
    if (c->record.n > 0 && isnan(checked.specific_wear_rate.value)) {
        c->has_wear = true; /* or a result of `weartrack record` contains it */
        checked.specific_wear_rate.value =
            1; /* placeholder for the check, until the records are read */
    }
    if (status == WT_OK)
        status = case_add_param_location(section, wt_layer_job_check(&checked, err), err);
    if (status == WT_OK && ratio != NULL && c->bulk.n > 0 && c->track.n > 0) {
        wt_fail(err, WT_E_ARG, "the modulus ratio is given and measured");
        wt_error_advice(err, "delete <modulus-ratio>, or the curves of bulk or track");
        return case_add_location(ratio, WT_E_ARG, err);
    }
    return status;
}

wt_status case_read_identify(wt_case *c, const xmlNode *section, wt_error *err)
{
    c->identifies = true;
    return case_read_params(c, section, wt_identify_job_params(), &c->identify, err);
}

/* ---- record ---------------------------------------------------------------------------------- */

wt_status case_read_record(wt_case *c, const xmlNode *section, wt_error *err)
{
    wt_status status = case_read_params(c, section, wt_record_job_params(), &c->records, err);
    if (status == WT_OK)
        status = case_read_params(c, section, wt_validation_job_params(), &c->validation, err);
    if (status == WT_OK && case_child(section, "profile") != NULL) {
        status = case_read_files(c, section, "profile", &c->profile, err);
        c->records.profile = status == WT_OK ? c->profile.sets[0].patterns[0] : NULL;
        c->records.profile_set = c->profile.sets;
    }
    if (status == WT_OK)
        status = case_add_param_location(section, wt_record_job_check(&c->records, err), err);
    if (status == WT_OK)
        status = case_read_files(c, section, "files", &c->record, err);
    c->has_wear = wear_is_requested(&c->records);
    return status;
}

/* ---- compare, report ------------------------------------------------------------------------- */

wt_status case_read_compare(wt_case *c, const xmlNode *section, wt_error *err)
{
    (void)err;
    c->has_compare = true;
    c->compare_groups = case_child(section, "track-to-bulk") != NULL;
    c->compare_rates = case_child(section, "by-rate") != NULL;
    c->compare_dma = case_child(section, "indentation-to-dma") != NULL;
    return WT_OK;
}

static wt_status fail_unknown_name(const xmlNode *node, const char *name, const char *kind,
                                   wt_error *err)
{
    wt_fail(err, WT_E_NOT_FOUND, "no %s is called \"%s\"", kind, name);
    wt_error_advice(err, "weartrack-case(5) lists the results and figures");
    return case_add_location(node, WT_E_NOT_FOUND, err);
}

wt_status case_read_report(wt_case *c, const xmlNode *section, wt_error *err)
{
    const char *style = NULL;
    wt_status status = case_read_params(c, section, wt_report_params(), &c->report, err);
    if (status == WT_OK && find_built_in_style(c->report.style, &style, err) != WT_OK)
        status = case_add_location(section, WT_E_NOT_FOUND, err);
    for (const xmlNode *node = section->children; status == WT_OK && node != NULL;
         node = node->next) {
        flow_resource_set resources = 0;
        if (node->type != XML_ELEMENT_NODE)
            continue;
        const bool figure = strcmp((const char *)node->name, "figure") == 0;
        /* a figure of a table has its name */
        const char *const name = table_current_name(case_node_text(c, node));
        const bool known = figure ? flow_figure_resources(name, &resources)
                                  : flow_table_resources(name, &resources);
        if (!known)
            status = fail_unknown_name(node, name, figure ? "figure" : "result", err);
        c->has_requests = true;
        c->requested |= resources;
    }
    return status;
}
