/* The sections of a case file, with what a schema cannot check.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "flow/case/case_sections.h"
#include "flow/run/stages.h"

#include <math.h>
#include <string.h>

/* ---- indentation ------------------------------------------------------------------------------
 */

static wt_status read_group(wt_case *c, const xmlNode *section, const char *name, case_files *files,
                            wt_error *err)
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
                return case_at(case_child(section, "track"), NULL, WT_E_ARG, err);
            }
    return WT_OK;
}

wt_status case_read_indentation(wt_case *c, const xmlNode *section, wt_error *err)
{
    const char *tip = NULL;
    wt_indent_options *o = &c->indent;
    wt_status status = case_get_text(c, section, "tip", &tip, err);
    if (status == WT_OK) {
        status = wt_tip_parse(tip, &c->tip, err);
        if (status == WT_OK)
            status = wt_tip_check(&c->tip, err);
        if (status != WT_OK)
            return case_at(case_child(section, "tip"), NULL, status, err);
        c->has_tip = true;
    }
    if (status == WT_OK)
        status = case_get_number(c, section, "poisson-ratio", WT_Q_NONE, &o->poisson_ratio, err);
    if (status == WT_OK)
        status = case_get_number(c, section, "temperature", WT_Q_TEMPERATURE,
                                 &c->indentation_temperature, err);
    if (status == WT_OK)
        status = case_get_number(c, section, "fit-depth", WT_Q_LENGTH, &o->fit_depth, err);
    if (status == WT_OK)
        status = case_get_number(c, section, "fit-force-fraction", WT_Q_NONE,
                                 &o->fit_force_fraction, err);
    if (status == WT_OK)
        status = case_get_flag(c, section, "fit-tilt", &o->fit_tilt, err);
    if (status == WT_OK)
        status =
            case_get_number(c, section, "minimum-r-squared", WT_Q_NONE, &o->minimum_r_squared, err);
    if (status == WT_OK)
        status = case_require(o->poisson_ratio >= 0 && o->poisson_ratio <= 0.5, section,
                              "poisson-ratio", "0 to 0.5", o->poisson_ratio, err);
    if (status == WT_OK)
        status = case_require(o->fit_depth >= 0, section, "fit-depth", "a positive length",
                              o->fit_depth, err);
    if (status == WT_OK)
        status = case_require(o->fit_force_fraction > 0 && o->fit_force_fraction <= 1, section,
                              "fit-force-fraction", "above 0, up to 1", o->fit_force_fraction, err);
    if (status == WT_OK)
        status = case_require(o->minimum_r_squared < 1, section, "minimum-r-squared", "below 1",
                              o->minimum_r_squared, err);
    if (status == WT_OK)
        status = read_group(c, section, "bulk", &c->bulk, err);
    if (status == WT_OK)
        status = read_group(c, section, "track", &c->track, err);
    return status == WT_OK ? check_disjoint(c, section, err) : status;
}

/* ---- dma --------------------------------------------------------------------------------------
 */

static wt_status read_terms(wt_case *c, const xmlNode *prony, wt_error *err)
{
    wt_prony *p = &c->prony;
    const char *deformation = NULL;
    wt_estimate low = {(double)NAN, 0, 0, ""}, high = {(double)NAN, 0, 0, ""};
    wt_status status = case_get_attribute(c, prony, "deformation", &deformation, err);
    if (status == WT_OK)
        status =
            case_get_number(c, prony, "equilibrium", WT_Q_MODULUS, &p->equilibrium_modulus, err);
    if (status == WT_OK)
        status = case_require(p->equilibrium_modulus >= 0, prony, "equilibrium", "0 or more",
                              p->equilibrium_modulus, err);
    if (status == WT_OK)
        status = case_get_attribute_estimate(c, prony, "frequency-min", WT_Q_ANGULAR_FREQUENCY,
                                             &low, err);
    if (status == WT_OK)
        status = case_get_attribute_estimate(c, prony, "frequency-max", WT_Q_ANGULAR_FREQUENCY,
                                             &high, err);
    if (status != WT_OK)
        return status;
    p->deformation = strcmp(deformation, "shear") == 0 ? WT_SHEAR : WT_TENSION;
    p->frequency_min = low.value;
    p->frequency_max = high.value;
    for (const xmlNode *node = case_child(prony, "term"); node != NULL;
         node = case_next(node, "term"))
        p->n++;
    p->relaxation_time = case_alloc(c, p->n * sizeof *p->relaxation_time);
    p->modulus = case_alloc(c, p->n * sizeof *p->modulus);
    if (p->relaxation_time == NULL || p->modulus == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    const xmlNode *node = case_child(prony, "term");
    for (size_t i = 0; i < p->n; i++, node = case_next(node, "term")) {
        wt_estimate time = {(double)NAN, 0, 0, "s"}, modulus = {(double)NAN, 0, 0, "Pa"};
        status = case_get_attribute_estimate(c, node, "time", WT_Q_TIME, &time, err);
        if (status == WT_OK)
            status = case_get_attribute_estimate(c, node, "modulus", WT_Q_MODULUS, &modulus, err);
        if (status != WT_OK)
            return status;
        if (!(time.value > 0) || !(modulus.value >= 0)) {
            wt_fail(err, WT_E_RANGE, "a Prony term needs a positive time and no negative modulus");
            return case_at(node, NULL, WT_E_RANGE, err);
        }
        p->relaxation_time[i] = time.value;
        p->modulus[i] = modulus.value;
    }
    c->has_prony = true;
    return WT_OK;
}

static wt_status read_wlf(wt_case *c, const xmlNode *wlf, wt_error *err)
{
    wt_estimate c1 = {0}, c2 = {0};
    wt_status status = case_get_estimate(c, wlf, "c1", WT_Q_NONE, &c1, err);
    if (status == WT_OK)
        status = case_get_estimate(c, wlf, "c2", WT_Q_TEMPERATURE_DIFFERENCE, &c2, err);
    if (status == WT_OK)
        status = case_require(c1.value > 0, wlf, "c1", "above 0", c1.value, err);
    if (status == WT_OK)
        status = case_require(c2.value > 0, wlf, "c2", "above 0 K", c2.value, err);
    if (status == WT_OK && isnan(c->shift.reference_temperature)) {
        wt_fail(err, WT_E_MISSING, "WLF constants mean nothing without their temperature");
        wt_error_expected(err, "<reference-temperature> in <dma>");
        return case_at(wlf, NULL, WT_E_MISSING, err);
    }
    c->c1 = c1.value;
    c->c2 = c2.value;
    c->c1_error = c1.standard_error;
    c->c2_error = c2.standard_error;
    c->has_wlf = status == WT_OK;
    return status;
}

wt_status case_read_dma(wt_case *c, const xmlNode *section, wt_error *err)
{
    const char *vertical = NULL;
    wt_prony_options *o = &c->prony_options;
    wt_status status =
        case_get_number(c, section, "poisson-ratio", WT_Q_NONE, &c->poisson_ratio, err);
    if (status == WT_OK)
        status = case_require(c->poisson_ratio >= 0 && c->poisson_ratio <= 0.5, section,
                              "poisson-ratio", "0 to 0.5", c->poisson_ratio, err);
    if (status == WT_OK)
        status = case_get_number(c, section, "reference-temperature", WT_Q_TEMPERATURE,
                                 &c->shift.reference_temperature, err);
    if (status == WT_OK)
        status = case_get_text(c, section, "vertical-shift", &vertical, err);
    if (status == WT_OK && vertical != NULL)
        c->shift.vertical = strcmp(vertical, "none") == 0       ? WT_VERTICAL_NONE
                            : strcmp(vertical, "physical") == 0 ? WT_VERTICAL_PHYSICAL
                                                                : WT_VERTICAL_FREE;
    if (status == WT_OK)
        status =
            case_get_number(c, section, "terms-per-decade", WT_Q_NONE, &o->terms_per_decade, err);
    if (status == WT_OK)
        status = case_require(o->terms_per_decade > 0, section, "terms-per-decade", "above 0",
                              o->terms_per_decade, err);
    if (status == WT_OK)
        status = case_get_number(c, section, "smoothing", WT_Q_NONE, &o->smoothing, err);
    if (status == WT_OK)
        status =
            case_require(o->smoothing >= 0, section, "smoothing", "0 or more", o->smoothing, err);
    if (status == WT_OK)
        status = case_get_flag(c, section, "liquid", &o->liquid, err);
    const xmlNode *prony = case_child(section, "prony"), *wlf = case_child(section, "wlf");
    if (status == WT_OK && prony != NULL)
        status = read_terms(c, prony, err);
    if (status == WT_OK && wlf != NULL)
        status = read_wlf(c, wlf, err);
    if (status == WT_OK && prony == NULL)
        status = case_read_files(c, section, "files", &c->dma, err);
    return status;
}

/* ---- roughness --------------------------------------------------------------------------------
 */

static wt_status read_self_affine(wt_case *c, const xmlNode *node, wt_error *err)
{
    wt_surface *s = &c->self_affine;
    wt_roughness *law = NULL;
    s->self_affine = true;
    s->qr = (double)NAN;
    wt_status status = case_get_number(c, node, "q0", WT_Q_WAVENUMBER, &s->q0, err);
    if (status == WT_OK)
        status = case_get_number(c, node, "qr", WT_Q_WAVENUMBER, &s->qr, err);
    if (status == WT_OK)
        status = case_get_number(c, node, "q1", WT_Q_WAVENUMBER, &s->q1, err);
    if (status == WT_OK)
        status = case_get_number(c, node, "hurst", WT_Q_NONE, &s->hurst, err);
    if (status == WT_OK)
        status = case_get_estimate(c, node, "c0", WT_Q_POWER_SPECTRUM_2D, &s->c0, err);
    if (status != WT_OK)
        return status;
    if (isnan(s->qr))
        s->qr = s->q0; /* no roll-off */
    status = wt_surface_roughness(s, 1, &law, err);
    wt_roughness_free(law);
    c->has_self_affine = status == WT_OK;
    return status == WT_OK ? WT_OK : case_at(node, NULL, status, err);
}

wt_status case_read_roughness(wt_case *c, const xmlNode *section, wt_error *err)
{
    const xmlNode *self_affine = case_child(section, "self-affine");
    if (self_affine != NULL)
        return read_self_affine(c, self_affine, err);
    const xmlNode *spectrum = case_child(section, "spectrum");
    wt_status status = case_read_files(c, spectrum, "file", &c->spectrum, err);
    if (status == WT_OK)
        status = case_get_number(c, spectrum, "q0", WT_Q_WAVENUMBER, &c->spectrum_q0, err);
    if (status == WT_OK)
        status = case_get_number(c, spectrum, "q1", WT_Q_WAVENUMBER, &c->spectrum_q1, err);
    if (status == WT_OK)
        status = case_get_number(c, spectrum, "error", WT_Q_NONE, &c->spectrum_error, err);
    if (status == WT_OK)
        status = case_require(c->spectrum_error >= 0, spectrum, "error",
                              "a relative error, 0 or more", c->spectrum_error, err);
    c->has_spectrum = status == WT_OK;
    return status;
}

/* ---- sliding ----------------------------------------------------------------------------------
 */

wt_status case_read_sliding(wt_case *c, const xmlNode *section, wt_error *err)
{
    wt_sliding *s = &c->sliding;
    wt_status status = case_get_estimate(c, section, "pressure", WT_Q_PRESSURE, &s->pressure, err);
    if (status == WT_OK)
        status = case_require(s->pressure.value > 0, section, "pressure", "above 0 Pa",
                              s->pressure.value, err);
    if (status == WT_OK)
        status =
            case_get_list(c, section, "velocity", WT_Q_VELOCITY, &s->velocity, &s->n_velocity, err);
    if (status == WT_OK)
        status = case_require(s->velocity[0] > 0, section, "velocity", "above 0 m/s",
                              s->velocity[0], err);
    if (status == WT_OK)
        status = case_get_number(c, section, "reference-velocity", WT_Q_VELOCITY,
                                 &s->reference_velocity, err);
    c->reference_velocity_given = !isnan(s->reference_velocity);
    if (status == WT_OK && c->reference_velocity_given)
        status = case_require(s->reference_velocity > 0, section, "reference-velocity",
                              "above 0 m/s", s->reference_velocity, err);
    if (status == WT_OK)
        status =
            case_get_estimate(c, section, "temperature", WT_Q_TEMPERATURE, &s->temperature, err);
    if (status == WT_OK)
        status = case_get_estimate(c, section, "shear-stress", WT_Q_STRESS, &s->shear_stress, err);
    if (status == WT_OK)
        status = case_require(!(s->shear_stress.value < 0), section, "shear-stress", "0 Pa or more",
                              s->shear_stress.value, err);
    if (status == WT_OK)
        status = case_get_number(c, section, "gamma", WT_Q_NONE, &s->gamma, err);
    if (status == WT_OK)
        status =
            case_require(s->gamma >= 0 && s->gamma <= 1, section, "gamma", "0 to 1", s->gamma, err);
    c->has_sliding = status == WT_OK;
    return status;
}

/* ---- layer ------------------------------------------------------------------------------------
 */

static wt_status check_layer(const wt_case *c, const xmlNode *section, wt_error *err)
{
    const wt_layer_job *l = &c->layer;
    bool energy = case_child(section, "critical-energy") != NULL;
    bool observed = case_child(section, "observed-thickness") != NULL;
    if (energy == observed) {
        wt_fail(err, WT_E_SCHEMA, "a layer has a critical energy or an observed thickness");
        wt_error_expected(err, "one of <critical-energy>, <observed-thickness>");
        wt_error_found(err, energy ? "both" : "neither");
        wt_error_advice(err, "from an observed thickness the critical energy is calculated");
        return case_at(section, NULL, WT_E_SCHEMA, err);
    }
    if (!isnan(c->modulus_ratio.value) && c->bulk.n > 0 && c->track.n > 0) {
        wt_fail(err, WT_E_ARG, "the modulus ratio is given and measured");
        wt_error_advice(err, "delete <modulus-ratio>, or the curves of bulk or track");
        return case_at(case_child(section, "modulus-ratio"), NULL, WT_E_ARG, err);
    }
    wt_status status = case_require(!energy || l->critical_energy.value > 0, section,
                                    "critical-energy", "above 0", l->critical_energy.value, err);
    if (status == WT_OK)
        status = case_require(!observed || l->observed_thickness.value > 0, section,
                              "observed-thickness", "above 0", l->observed_thickness.value, err);
    if (status == WT_OK)
        status = case_require(
            observed ? l->specific_wear_rate.value > 0 : l->specific_wear_rate.value >= 0, section,
            "specific-wear-rate",
            observed ? "above 0, as the layer is calibrated against wear" : "0 or more",
            l->specific_wear_rate.value, err);
    if (status == WT_OK)
        status = case_require(l->damage > 0, section, "damage", "above 0", l->damage, err);
    if (status == WT_OK)
        status = case_require(l->duty > 0 && l->duty <= 1, section, "duty", "above 0, up to 1",
                              l->duty, err);
    if (status == WT_OK)
        status = case_require(l->start_thickness >= 0, section, "start-thickness", "0 or more",
                              l->start_thickness, err);
    if (status == WT_OK)
        status = case_require(!(c->layer_velocity <= 0), section, "velocity", "above 0 m/s",
                              c->layer_velocity, err);
    if (status == WT_OK)
        status = case_require(!(c->modulus_ratio.value <= 0), section, "modulus-ratio", "above 0",
                              c->modulus_ratio.value, err);
    if (status == WT_OK && l->time != NULL)
        status = case_require(l->time[0] >= 0, section, "times", "0 s or later", l->time[0], err);
    return status;
}

wt_status case_read_layer(wt_case *c, const xmlNode *section, wt_error *err)
{
    wt_layer_job *l = &c->layer;
    const char *profile = NULL;
    wt_status status = case_get_estimate(c, section, "specific-wear-rate", WT_Q_WEAR_RATE,
                                         &l->specific_wear_rate, err);
    if (status == WT_OK)
        status = case_get_estimate(c, section, "critical-energy", WT_Q_ENERGY_DENSITY,
                                   &l->critical_energy, err);
    if (status == WT_OK)
        status = case_get_estimate(c, section, "observed-thickness", WT_Q_LENGTH,
                                   &l->observed_thickness, err);
    if (status == WT_OK)
        status = case_get_number(c, section, "velocity", WT_Q_VELOCITY, &c->layer_velocity, err);
    if (status == WT_OK)
        status = case_get_number(c, section, "damage", WT_Q_NONE, &l->damage, err);
    if (status == WT_OK)
        status = case_get_number(c, section, "duty", WT_Q_NONE, &l->duty, err);
    if (status == WT_OK)
        status =
            case_get_number(c, section, "start-thickness", WT_Q_LENGTH, &l->start_thickness, err);
    if (status == WT_OK)
        status = case_get_flag(c, section, "incubation", &l->incubation, err);
    if (status == WT_OK)
        status = case_get_text(c, section, "profile", &profile, err);
    if (status == WT_OK && profile != NULL)
        l->profile =
            strcmp(profile, "incompressible") == 0 ? WT_PROFILE_INCOMPRESSIBLE : WT_PROFILE_PERSSON;
    if (status == WT_OK)
        status = case_get_number(c, section, "local-friction", WT_Q_NONE, &l->local_friction, err);
    if (status == WT_OK)
        status = case_get_list(c, section, "times", WT_Q_TIME, &l->time, &l->n_time, err);
    if (status == WT_OK)
        status = case_get_estimate(c, section, "modulus-ratio", WT_Q_NONE, &c->modulus_ratio, err);
    if (status == WT_OK)
        status = check_layer(c, section, err);
    c->has_layer = status == WT_OK;
    return status;
}

/* ---- compare, report --------------------------------------------------------------------------
 */

wt_status case_read_compare(wt_case *c, const xmlNode *section, wt_error *err)
{
    (void)err;
    c->has_compare = true;
    c->compare_groups = case_child(section, "track-to-bulk") != NULL;
    c->compare_rates = case_child(section, "by-rate") != NULL;
    c->compare_dma = case_child(section, "indentation-to-dma") != NULL;
    return WT_OK;
}

static wt_status unknown_name(const xmlNode *node, const char *name, const char *kind,
                              wt_error *err)
{
    wt_fail(err, WT_E_NOT_FOUND, "no %s is called \"%s\"", kind, name);
    wt_error_advice(err, "weartrack-case(5) lists the results and figures");
    return case_at(node, NULL, WT_E_NOT_FOUND, err);
}

wt_status case_read_report(wt_case *c, const xmlNode *section, wt_error *err)
{
    wt_status status = case_get_attribute(c, section, "style", &c->style, err);
    size_t n = 0;
    for (const xmlNode *node = section->children; node != NULL; node = node->next)
        n += node->type == XML_ELEMENT_NODE;
    c->asked = case_alloc(c, n * sizeof *c->asked);
    if (status == WT_OK && c->asked == NULL)
        status = wt_fail(err, WT_E_MEMORY, "out of memory");
    for (const xmlNode *node = section->children; status == WT_OK && node != NULL;
         node = node->next) {
        const char *name = NULL;
        if (node->type != XML_ELEMENT_NODE)
            continue;
        status = case_node_text(c, node, &name, err);
        if (status != WT_OK)
            break;
        const bool is_figure = strcmp((const char *)node->name, "figure") == 0;
        const char *table = is_figure                   ? flow_figure_table(name)
                            : flow_table_is_known(name) ? name
                                                        : NULL;
        if (table == NULL)
            status = unknown_name(node, name, is_figure ? "figure" : "result", err);
        else
            c->asked[c->n_asked++] = table;
    }
    return status;
}
