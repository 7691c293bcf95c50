/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "places.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

static const char shifts[] = "shift_factors", curve[] = "master_curve", friction[] = "friction";

const place place_shift = {shifts, "log_a", NULL, "log_a_low", "log_a_high"};
const place place_law = {shifts, "law_log_a", NULL, "law_log_a_low", "law_log_a_high"};
const place place_c1 = {shifts, "wlf_c1", "standard_error", NULL, NULL};
const place place_c2 = {shifts, "wlf_c2", "standard_error", NULL, NULL};
const place place_storage = {curve, "fitted_storage", NULL, "fitted_storage_low",
                             "fitted_storage_high"};
const place place_loss = {curve, "fitted_loss", NULL, "fitted_loss_low", "fitted_loss_high"};
const place place_equilibrium = {PLACE_PRONY, "equilibrium_modulus", "standard_error", NULL,
                                 "equilibrium_modulus_limit"};
const place place_hysteresis = {friction, "hysteresis", "hysteresis_standard_error", NULL, NULL};
const place place_area = {friction, "area_ratio", "area_ratio_standard_error", NULL, NULL};
const place place_friction = {friction, "friction", "friction_standard_error", NULL, NULL};
const place place_thickness = {"layer", "balance_thickness", "standard_error", NULL, NULL};

const place place_modulus = {"indentation/bulk", "modulus", "modulus_standard_error", NULL, NULL};
const place place_factor = {"indentation/bulk", "spectrum_factor", "spectrum_factor_standard_error",
                            NULL, NULL};
const place place_depth = {PLACE_DEPTH, "modulus", NULL, "low", "high"};
const place place_budget[2] = {
    {"modulus_budget", "modulus_bulk", NULL, "low_bulk", "high_bulk"},
    {"modulus_budget", "modulus_track", NULL, "low_track", "high_track"}};
const place place_ratio = {"comparison", "ratio", NULL, "ratio_low", "ratio_high"};
const place place_layered_friction = {friction, "friction_with_layer_at_reference",
                                      "standard_error", NULL, NULL};

static const char surface[] = "power_spectrum";
const place place_density = {surface, "density", NULL, "density_low", "density_high"};
const place place_hurst = {surface, "hurst", "standard_error", NULL, NULL};
const place place_roll_off = {surface, "roll_off", "standard_error", NULL, NULL};
const place place_c0 = {surface, "c0", "standard_error", NULL, NULL};
const place place_rms_height = {surface, "rms_height", "standard_error", NULL, NULL};
const place place_rms_slope = {surface, "rms_slope", "standard_error", NULL, NULL};
const place place_anisotropy = {surface, "anisotropy", "standard_error", NULL, NULL};
const place place_texture = {surface, "anisotropy_direction", "standard_error", NULL, NULL};

static const char record[] = "record";
const place place_steady = {record, "friction_coefficient", NULL, "friction_coefficient_low",
                            "friction_coefficient_high"};
const place place_running_in = {record, "running_in", NULL, "running_in_low", "running_in_high"};
const place place_running_in_time = {record, "running_in_time", NULL, "running_in_time_low",
                                     "running_in_time_high"};
const place place_drift = {record, "drift", NULL, "drift_low", "drift_high"};
const place place_wear_rate = {"wear", "specific_wear_rate", NULL, "specific_wear_rate_low",
                               "specific_wear_rate_high"};

const place place_energy = {"identification", "critical_energy", NULL, "critical_energy_low",
                            "critical_energy_high"};
const place place_energy_wear = {"identification", "specific_wear_rate", NULL,
                                 "specific_wear_rate_low", "specific_wear_rate_high"};
const place place_friction_ratio = {PLACE_VALIDATION, "ratio", NULL, "ratio_low", "ratio_high"};
const place place_needed_shear = {PLACE_VALIDATION, "shear_stress_needed", NULL,
                                  "shear_stress_needed_low", "shear_stress_needed_high"};

static const char collection[] = "collection";
const place place_collected_ratio = {collection, "modulus_ratio", NULL, "modulus_ratio_low",
                                     "modulus_ratio_high"};
const place place_collected_thickness = {collection, "balance_thickness", NULL,
                                         "balance_thickness_low", "balance_thickness_high"};
const place place_collected_change = {collection, "friction_change", NULL, "friction_change_low",
                                      "friction_change_high"};
const place place_collected_modulus = {"collected_modulus", "modulus", NULL, "modulus_low",
                                       "modulus_high"};
const place place_collected_friction = {"collected_friction", "friction", "friction_standard_error",
                                        NULL, NULL};
const place place_pair = {"ratio_pairs", "ratio", NULL, "ratio_low", "ratio_high"};
const place place_settled_predicted = {PLACE_VALIDATION_RUNNING_IN, "settled_predicted",
                                       "settled_predicted_standard_error", NULL, NULL};
const place place_settled_measured = {PLACE_VALIDATION_RUNNING_IN, "settled_measured", NULL,
                                      "settled_measured_low", "settled_measured_high"};
const place place_time_ratio = {PLACE_VALIDATION_RUNNING_IN, "time_ratio", NULL, "time_ratio_low",
                                "time_ratio_high"};

static const double normal95 = 1.959963984540054;

/* Lower and upper limits if they exist, else the standard error to both sides. */
static estimate stated(double value, double error, double low, double high)
{
    if (isnan(low) && isnan(high) && !isnan(error)) {
        low = value - normal95 * error;
        high = value + normal95 * error;
    }
    /* An upper limit alone is an interval, too. */
    if (isnan(low) && !isnan(high))
        low = -(double)INFINITY;
    return (estimate){value, low, high};
}

static double cell(const stream *s, const place *p, const char *column, int row)
{
    return column != NULL ? stream_cell(s, p->table, column, row) : (double)NAN;
}

estimate place_row(const stream *s, const place *p, int row)
{
    return stated(cell(s, p, p->value, row), cell(s, p, p->error, row), cell(s, p, p->low, row),
                  cell(s, p, p->high, row));
}

/* Attribute of the key, or separate key. */
static double attribute(const stream *s, const place *p, const char *name)
{
    if (name == NULL)
        return (double)NAN;
    const double found = stream_number(s, p->table, p->value, name);
    return isnan(found) ? stream_number(s, p->table, name, NULL) : found;
}

estimate place_key(const stream *s, const place *p)
{
    return stated(stream_number(s, p->table, p->value, NULL), attribute(s, p, p->error),
                  attribute(s, p, p->low), attribute(s, p, p->high));
}

verdict place_friction_verdict(const stream *found, const char *table)
{
    static const char *const words[] = {
        [YES] = "yes", [NO] = "no", [INCONCLUSIVE] = "inconclusive"};
    const char *said = stream_key(found, table, PLACE_VALIDATION_VERDICT);
    for (int v = 0; said != NULL && v < (int)(sizeof words / sizeof *words); v++)
        if (strncmp(said, words[v], strlen(words[v])) == 0)
            return (verdict)v;
    return NO_VERDICT;
}
