/* Accuracy of hysteresis friction for each kind of material.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/precision.h"
#include "bench/reference_values.h"
#include "study/textbook_methods.h"

#include <math.h>

/* Sizes of the problems; Gauss order of the reference, and a lower order for its error. */
enum { TERMS = 6, KNOTS = 107, ORDER = 20, CHECK = 16 };

typedef struct friction_problem {
    reference_contact contact;
    wt_material *material;
    wt_roughness *roughness;
    double truth, found, stated;
} friction_problem;

static const reference_contact contact = {.material = {.e0 = 5e6,
                                                       .alpha = 1,
                                                       .n = TERMS,
                                                       .e = {3e6, 5e6, 2e7, 1e8, 5e8, 4e8},
                                                       .tau = {1e-2, 1e-3, 1e-5, 1e-6, 1e-7, 1e-8}},
                                          .poisson_ratio = 0.5,
                                          .pressure = 3e5,
                                          .velocity = 0.1,
                                          .q0 = 500,
                                          .qr = 2000,
                                          .q1 = 1e6,
                                          .hurst = 0.8,
                                          .c0 = 6e-16};

static wt_status create_roughness(friction_problem *p, wt_error *err)
{
    const reference_contact *c = &p->contact;
    return wt_roughness_self_affine(c->q0, c->qr, c->q1, c->hurst, c->c0, &p->roughness, err);
}

static void finish_friction(void *problem)
{
    friction_problem *p = problem;
    wt_material_free(p->material);
    wt_roughness_free(p->roughness);
}

/* The difference of two orders is the error of the lower one, which bounds that of the higher. */
static void set_reference(friction_problem *p, double *reference_error)
{
    p->truth = reference_friction(&p->contact, ORDER);
    *reference_error = precision_relative(reference_friction(&p->contact, CHECK), p->truth);
}

static wt_status create_prony_material(const reference_contact *c, wt_material **material,
                                       wt_error *err)
{
    wt_prony prony = {0};
    wt_prony_alloc(&prony, c->material.n);
    prony.deformation = WT_TENSION;
    prony.reference_temperature = prony.frequency_min = prony.frequency_max = (double)NAN;
    prony.equilibrium_modulus = c->material.e0;
    for (size_t k = 0; k < c->material.n; k++) {
        prony.modulus[k] = c->material.e[k];
        prony.relaxation_time[k] = c->material.tau[k];
    }
    const wt_status status = wt_material_prony(&prony, c->poisson_ratio, material, err);
    wt_prony_clear(&prony);
    return status;
}

static wt_status begin_prony(void *problem, double *reference_error, wt_error *err)
{
    friction_problem *p = problem;
    p->contact = contact;
    wt_status status = create_roughness(p, err);
    if (status == WT_OK)
        status = create_prony_material(&p->contact, &p->material, err);
    if (status == WT_OK)
        set_reference(p, reference_error);
    return status;
}

static wt_status begin_zener(void *problem, double *reference_error, wt_error *err)
{
    const double e0 = 5e6, glass = 1e9, tau = 1e-7, alpha = 0.5;
    friction_problem *p = problem;
    p->contact = contact;
    p->contact.material =
        (reference_material){.e0 = e0, .alpha = alpha, .n = 1, .e = {glass - e0}, .tau = {tau}};
    wt_status status = create_roughness(p, err);
    if (status == WT_OK)
        status = wt_material_fractional_zener(e0, glass, tau, alpha, p->contact.poisson_ratio,
                                              &p->material, err);
    if (status == WT_OK)
        set_reference(p, reference_error);
    return status;
}

/* The normal direction is stiffer and has more loss. The plane and shear use the series. */
static wt_status begin_transverse(void *problem, double *reference_error, wt_error *err)
{
    friction_problem *p = problem;
    wt_transverse factors = wt_transverse_defaults();
    wt_material *series = NULL;
    factors.axial_storage = 1.5;
    factors.axial_loss = 2;
    p->contact = contact;
    p->contact.poisson_ratio = 0.45;
    p->contact.material.axial_storage = factors.axial_storage;
    p->contact.material.axial_loss = factors.axial_loss;
    p->contact.material.poisson_ratio = p->contact.poisson_ratio;
    wt_status status = create_roughness(p, err);
    if (status == WT_OK)
        status = create_prony_material(&p->contact, &series, err);
    if (status == WT_OK)
        status = wt_material_transverse(series, NULL, NULL, &factors, p->contact.poisson_ratio,
                                        &p->material, err);
    if (status == WT_OK)
        set_reference(p, reference_error);
    return status;
}

static wt_status solve_kernel(friction_problem *p, double tolerance, wt_estimate *mu, wt_error *err)
{
    wt_friction_options options = wt_friction_defaults();
    wt_friction_workspace *workspace = NULL;
    wt_friction_point point;
    options.tolerance = tolerance;
    wt_status status =
        wt_friction_workspace_new(p->material, p->roughness, &options, &workspace, err);
    if (status == WT_OK)
        status = wt_friction_compute(workspace, p->contact.pressure, &p->contact.velocity, 1,
                                     &point, err);
    wt_friction_workspace_free(workspace);
    if (status == WT_OK)
        *mu = point.hysteresis;
    return status;
}

/* Creates a table of the Prony series at the knots. */
static wt_status create_table_material(const reference_contact *c, wt_material **material,
                                       wt_error *err)
{
    double omega[KNOTS], storage[KNOTS], loss[KNOTS];
    wt_material *series = NULL;
    wt_status status = create_prony_material(c, &series, err);
    if (status != WT_OK)
        return status;
    for (int k = 0; k < KNOTS; k++)
        omega[k] = pow(10, 12.0 * k / (KNOTS - 1));
    series->law->modulus(series, omega, KNOTS, storage, loss);
    status = wt_material_table(omega, storage, loss, KNOTS, c->poisson_ratio, WT_EXTRAPOLATE_HOLD,
                               material, err);
    wt_material_free(series);
    return status;
}

/* The reference is the kernel itself at its smallest tolerance. */
static wt_status begin_table_material(void *problem, double *reference_error, wt_error *err)
{
    friction_problem *p = problem;
    wt_estimate tight = {0};
    p->contact = contact;
    wt_status status = create_roughness(p, err);
    if (status == WT_OK)
        status = create_table_material(&p->contact, &p->material, err);
    if (status == WT_OK)
        status = solve_kernel(p, 1e-13, &tight, err);
    p->truth = tight.value;
    *reference_error = tight.numerical_error / tight.value;
    return status;
}

static wt_status solve_weartrack(void *problem, double value, wt_error *err)
{
    friction_problem *p = problem;
    wt_estimate mu = {0};
    const wt_status status = solve_kernel(p, 1 / value, &mu, err);
    p->found = mu.value;
    p->stated = mu.numerical_error / mu.value;
    return status;
}

/* The number of angles is a tenth of the number of wavenumbers. */
static wt_status solve_textbook_friction(void *problem, double value, wt_error *err)
{
    enum { LEAST_ANGLES = 20 }; /* a usual number for a textbook rule */
    friction_problem *p = problem;
    const size_t n = (size_t)value, angles = n / 20 * 2;
    textbook_friction result = {0, 0, 0};
    const wt_status status = textbook_friction_compute(
        p->material, p->roughness, p->contact.pressure, p->contact.velocity, n,
        angles > LEAST_ANGLES ? angles : LEAST_ANGLES, &result);
    p->found = result.hysteresis;
    p->stated = (double)NAN;
    return status == WT_OK ? status : wt_fail(err, status, "the textbook method failed");
}

static precision_errors friction_errors(const void *problem)
{
    const friction_problem *p = problem;
    return (precision_errors){precision_relative(p->found, p->truth), p->stated};
}

#define FRICTION_METHODS                                                                           \
    {                                                                                              \
        {"weartrack", "1 / tolerance", {1e2, 1e4, 1e6, 1e8, 1e10, 1e12}, solve_weartrack},         \
        {                                                                                          \
            "textbook", "wavenumbers", {30, 100, 300, 1000, 3000}, solve_textbook_friction         \
        }                                                                                          \
    }

const precision_part precision_friction[] = {
    {.name = "friction-prony",
     "Hysteresis friction at one velocity with set-up, Prony series of 6 terms; reference: long "
     "double, other rules",
     sizeof(friction_problem),
     begin_prony,
     friction_errors,
     finish_friction,
     FRICTION_METHODS,
     .is_bound = true},
    {.name = "friction-zener",
     "The same for a fractional Zener law; reference: long double, other rules",
     sizeof(friction_problem),
     begin_zener,
     friction_errors,
     finish_friction,
     FRICTION_METHODS,
     .is_bound = true},
    {.name = "friction-transverse",
     "The same for the series with directions: along the surface normal 1.5 E' and 2 E''; "
     "reference: long double, other rules",
     sizeof(friction_problem),
     begin_transverse,
     friction_errors,
     finish_friction,
     FRICTION_METHODS,
     .is_bound = true},
    {.name = "friction-table",
     "The same for a table of 107 knots; reference: the kernel at the tolerance 1e-13",
     sizeof(friction_problem),
     begin_table_material,
     friction_errors,
     finish_friction,
     FRICTION_METHODS,
     .is_bound = true},
    {.name = NULL},
};
