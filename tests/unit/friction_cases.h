/* Builds the material and the roughness of a friction case from tests/numeric/friction.txt. */
#ifndef WT_TESTS_FRICTION_CASES_H
#define WT_TESTS_FRICTION_CASES_H

#include "numeric/cases.h"
#include "weartrack/model.h"

#include <math.h>

static inline wt_status friction_case_law(const numeric_case *c, wt_material **material,
                                          wt_error *err)
{
    const char *kind = case_word(c, false, "material");
    const double nu = case_number(c, false, "poisson_ratio", (double)NAN);
    if (strcmp(kind, "prony") == 0) {
        const case_line *modulus = case_find(c, false, "modulus");
        const case_line *tau = case_find(c, false, "relaxation_time");
        double e_k[CASE_VALUES], tau_k[CASE_VALUES];
        wt_prony prony = {.deformation = WT_TENSION,
                          .reference_temperature = (double)NAN,
                          .equilibrium_modulus = case_number(c, false, "equilibrium_modulus", 0),
                          .relaxation_time = tau_k,
                          .modulus = e_k,
                          .frequency_min = (double)NAN,
                          .frequency_max = (double)NAN};
        if (modulus && tau) {
            prony.n = modulus->n;
            memcpy(e_k, modulus->value, sizeof e_k);
            memcpy(tau_k, tau->value, sizeof tau_k);
        }
        return wt_material_prony(&prony, nu, material, err);
    }
    if (strcmp(kind, "table") == 0) {
        const case_line *omega = case_find(c, false, "angular_frequency");
        const case_line *storage = case_find(c, false, "storage_modulus");
        const case_line *loss = case_find(c, false, "loss_modulus");
        const bool hold = strcmp(case_word(c, false, "extrapolation"), "hold") == 0;
        if (!omega || !storage || !loss)
            return wt_fail(err, WT_E_MISSING, "case %s has no table", c->name);
        return wt_material_table(omega->value, storage->value, loss->value, omega->n, nu,
                                 hold ? WT_EXTRAPOLATE_HOLD : WT_EXTRAPOLATE_SLOPE, material, err);
    }
    return wt_material_fractional_zener(
        case_number(c, false, "e0", (double)NAN), case_number(c, false, "eg", (double)NAN),
        case_number(c, false, "tau", (double)NAN), case_number(c, false, "alpha", (double)NAN), nu,
        material, err);
}

/* The law, or a transversely isotropic material of factors on it. */
static inline wt_status friction_case_material(const numeric_case *c, wt_material **material,
                                               wt_error *err)
{
    const case_line *axial = case_find(c, false, "axial"), *plane = case_find(c, false, "plane"),
                    *shear = case_find(c, false, "shear");
    wt_material *law = NULL;
    const wt_status status = friction_case_law(c, &law, err);
    if (status != WT_OK || !axial || !plane || !shear) {
        *material = law;
        return status;
    }
    wt_transverse t = wt_transverse_defaults();
    t.axial_storage = axial->value[0];
    t.axial_loss = axial->value[1];
    t.plane_storage = plane->value[0];
    t.plane_loss = plane->value[1];
    t.shear_storage = shear->value[0];
    t.shear_loss = shear->value[1];
    t.plane_poisson = case_number(c, false, "plane_poisson", (double)NAN);
    t.axial_poisson = case_number(c, false, "axial_poisson", (double)NAN);
    return wt_material_transverse(law, NULL, NULL, &t, law->poisson_ratio, material, err);
}

static inline wt_status friction_case_roughness(const numeric_case *c, wt_roughness **roughness,
                                                wt_error *err)
{
    const case_line *q = case_find(c, false, "wavenumber");
    const case_line *density = case_find(c, false, "density");
    if (q && density)
        return wt_roughness_table(q->value, density->value, q->n, roughness, err);
    return wt_roughness_self_affine(
        case_number(c, false, "q0", (double)NAN), case_number(c, false, "qr", (double)NAN),
        case_number(c, false, "q1", (double)NAN), case_number(c, false, "hurst", (double)NAN),
        case_number(c, false, "c0", (double)NAN), roughness, err);
}

#endif
