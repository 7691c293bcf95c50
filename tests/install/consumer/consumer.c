/* Small program that uses the installed library: some structures by their defaults, some zeroed,
 * one inside another.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdio.h>
#include <weartrack/weartrack.h>

static wt_status contact(double *g, wt_error *err)
{
    wt_tip tip = {0};
    double slope = 0;
    wt_status status = wt_tip_parse("pyramid:half-angle=35deg,radius=20nm", &tip, err);
    if (status == WT_OK)
        wt_contact_function(&tip, 70e-9, g, &slope);
    return status;
}

/* Friction at 0.1 m/s of a rubber with one relaxation time under a thin soft layer. */
static wt_status friction(double *mu, wt_error *err)
{
    wt_prony prony = {0};
    wt_material *material = NULL;
    wt_roughness *roughness = NULL;
    wt_friction_workspace *workspace = NULL;
    wt_friction_options options = wt_friction_defaults();
    options.layer = (wt_layer_state){.thickness = 1e-6, .modulus_ratio = 0.7};
    const double velocity = 0.1;
    wt_friction_point point;
    wt_prony_alloc(&prony, 1);
    prony.equilibrium_modulus = 5e6;
    prony.modulus[0] = 1e8;
    prony.relaxation_time[0] = 1e-5;
    wt_status status = wt_material_prony(&prony, 0.5, &material, err);
    if (status == WT_OK)
        status = wt_roughness_self_affine(2e3, 4e3, 2e6, 0.8, 2e-17, &roughness, err);
    if (status == WT_OK)
        status = wt_friction_workspace_new(material, roughness, &options, &workspace, err);
    if (status == WT_OK)
        status = wt_friction_compute(workspace, 4e5, &velocity, 1, &point, err);
    if (status == WT_OK)
        *mu = point.hysteresis.value;
    wt_friction_workspace_free(workspace);
    wt_roughness_free(roughness);
    wt_material_free(material);
    wt_prony_clear(&prony);
    return status;
}

/* A structure with the same layout in the library and in this program, also after a nested
 * structure. */
static bool curve(void)
{
    wt_force_curve curve = {0};
    bool good = wt_force_curve_add_segment(&curve, WT_SEGMENT_APPROACH, 3, 2) != NULL &&
                wt_force_curve_add_segment(&curve, WT_SEGMENT_RETRACT, 5, 2) != NULL;
    if (good) {
        wt_segment *retract = &curve.segments[1];
        retract->channels[1].quantity = WT_Q_FORCE;
        good = curve.n_segments == 2 && retract->n_points == 5 &&
               wt_force_curve_segment(&curve, WT_SEGMENT_RETRACT) == retract &&
               wt_segment_channel(retract, WT_Q_FORCE) == &retract->channels[1];
    }
    wt_force_curve_clear(&curve);
    return good;
}

/* Steady-state thickness if one wavenumber has all the energy. */
static wt_status layer(double *thickness, wt_error *err)
{
    double wavenumber = 1e6, power = 2e4;
    wt_energy_source source = {0};
    source.n = 1;
    source.wavenumber = &wavenumber;
    source.power = &power;
    wt_layer_parameters parameters = wt_layer_defaults();
    parameters.critical_energy = 2e10;
    parameters.specific_wear_rate = 1e-12;
    parameters.pressure = 4e5;
    parameters.velocity = 0.1;
    wt_layer_steady_state balance;
    wt_status status = wt_layer_steady_state_compute(&source, &parameters, &balance, err);
    if (status == WT_OK)
        *thickness = balance.thickness.value;
    return status;
}

int main(void)
{
    wt_error err = WT_ERROR_INIT;
    double g = 0, mu = 0, thickness = 0;
    if (contact(&g, &err) != WT_OK || friction(&mu, &err) != WT_OK ||
        layer(&thickness, &err) != WT_OK) {
        char text[1024];
        wt_error_format(&err, text, sizeof text);
        fprintf(stderr, "%s\n", text);
        return 1;
    }
    printf("weartrack %s: G(70 nm) = %.6g m^2, mu_hys = %.6g, layer %.6g m\n", wt_version(), g, mu,
           thickness);
    return curve() && g > 0 && mu > 0 && thickness > 0 && isfinite(g + mu + thickness) ? 0 : 1;
}
