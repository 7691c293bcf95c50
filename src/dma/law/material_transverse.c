/* Transversely isotropic half-space with its axis along the surface normal, as an equivalent
 * isotropic solid.
 *
 * The surface compliance D in u_z(q) = (D / q) sigma_z(q) is 2 (1 - nu^2) / E for an isotropic
 * solid. The laws of the surface therefore use E = 2 (1 - nu^2) / D.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/law/material.h"

#include "core/base/array.h"
#include "core/base/text.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

enum { PLANE, AXIAL, SHEAR, N_MODULI };

typedef struct transverse_data {
    wt_material *law[N_MODULI]; /* entries may share one material */
    wt_transverse parameters;
    double stiffness; /* 2 (1 - nu^2) */
    size_t n_breaks;
    double *breaks; /* breaks of all laws, rising [rad/s] */
} transverse_data;

wt_transverse wt_transverse_defaults(void)
{
    return (wt_transverse){.plane_storage = 1,
                           .plane_loss = 1,
                           .axial_storage = 1,
                           .axial_loss = 1,
                           .shear_storage = 1,
                           .shear_loss = 1,
                           .plane_poisson = (double)NAN,
                           .axial_poisson = (double)NAN};
}

static const wt_param rows[] = {
    {PARAM("axial-storage", wt_transverse, axial_storage, WT_Q_NONE, ABOVE(0)), .value = "X",
     .help = "E' along the surface normal over that of the material"},
    {PARAM("axial-loss", wt_transverse, axial_loss, WT_Q_NONE, AT_LEAST(0)), .value = "X",
     .help = "E'' along the surface normal over that of the material"},
    {PARAM("plane-storage", wt_transverse, plane_storage, WT_Q_NONE, ABOVE(0)), .value = "X",
     .help = "E' in the plane of the surface over that of the material"},
    {PARAM("plane-loss", wt_transverse, plane_loss, WT_Q_NONE, AT_LEAST(0)), .value = "X",
     .help = "E'' in the plane of the surface over that of the material"},
    {PARAM("shear-storage", wt_transverse, shear_storage, WT_Q_NONE, ABOVE(0)), .value = "X",
     .help = "storage modulus of shear between normal and plane over E' / (2 (1 + nu_p))"},
    {PARAM("shear-loss", wt_transverse, shear_loss, WT_Q_NONE, AT_LEAST(0)), .value = "X",
     .help = "loss modulus of shear between normal and plane over E'' / (2 (1 + nu_p))"},
    {PARAM("plane-poisson", wt_transverse, plane_poisson, WT_Q_NONE, BRACED(-1, 1, false, false)),
     .value = "NU", .unset = "the Poisson ratio",
     .help = "nu_p: contraction in the plane of the surface under a load in it"},
    {PARAM("axial-poisson", wt_transverse, axial_poisson, WT_Q_NONE, ANY_NUMBER), .value = "NU",
     .unset = "the Poisson ratio",
     .help = "nu_zp: contraction in the plane of the surface under a load along its normal"},
};
PARAM_TABLE(wt_transverse_params, wt_transverse, rows, wt_transverse_defaults, NO_PARTS)

/* ---- surface compliance ---------------------------------------------------------------------- */

/* In plane strain, with a = Ep / Ez:
 *     b11 = (1 - nu_p^2) / Ep,   b33 = (1 - nu_zp^2 a) / Ez,   b13 = -nu_zp (1 + nu_p) / Ez */
static double complex axial_compliance(const transverse_moduli *m)
{
    return (1 - m->axial_poisson * m->axial_poisson * (m->plane / m->axial)) / m->axial;
}

/* Returns sqrt(b11 b33) + b13. For an incompressible solid this is a difference of equal
 * numbers. It is therefore computed as its product with sqrt(b11 b33) - b13, divided by the
 * latter. *scale: size of the terms that cancel. */
static double complex volume_compliance(const transverse_moduli *m, double *scale)
{
    const double nu_p = m->plane_poisson, nu_zp = m->axial_poisson;
    const double complex root = csqrt((1 - nu_p * nu_p) / m->plane) * csqrt(axial_compliance(m));
    const double complex b13 = -nu_zp * (1 + nu_p) / m->axial;
    const double complex other = (1 + nu_p) / m->plane / (m->axial * (root - b13));
    *scale = cabs(other);
    if (nu_zp <= 0)
        return root + b13;
    return other * ((1 - nu_p) - 2 * nu_zp * nu_zp * (m->plane / m->axial));
}

double complex transverse_compliance(const transverse_moduli *m)
{
    double scale;
    return csqrt(axial_compliance(m)) * csqrt(1 / m->shear + 2 * volume_compliance(m, &scale));
}

static double complex complex_number(double real, double imaginary)
{
    const double parts[2] = {real, imaginary};
    double complex z;
    memcpy(&z, parts, sizeof z);
    return z;
}

/* Number of frequencies in one pass; they fit in the first cache. */
enum { CHUNK = 32 };

static void directional_moduli(const transverse_data *d, const double *omega, size_t n,
                               transverse_moduli *m)
{
    const wt_transverse *t = &d->parameters;
    const double factor[N_MODULI][2] = {
        [PLANE] = {t->plane_storage, t->plane_loss},
        [AXIAL] = {t->axial_storage, t->axial_loss},
        [SHEAR] = {t->shear_storage, t->shear_loss},
    };
    const double to_shear = 1 / (2 * (1 + t->plane_poisson));
    double storage[CHUNK], loss[CHUNK];
    for (size_t k = 0; k < N_MODULI; k++) {
        if (k == 0 || d->law[k] != d->law[k - 1])
            d->law[k]->law->modulus(d->law[k], omega, n, storage, loss);
        const double scale = k == SHEAR ? to_shear : 1;
        for (size_t i = 0; i < n; i++) {
            const double complex e = complex_number(scale * (factor[k][0] * storage[i]),
                                                    scale * (factor[k][1] * loss[i]));
            *(k == PLANE ? &m[i].plane : k == AXIAL ? &m[i].axial : &m[i].shear) = e;
            m[i].plane_poisson = t->plane_poisson;
            m[i].axial_poisson = t->axial_poisson;
        }
    }
}

static void transverse_modulus(const wt_material *material, const double *omega, size_t n,
                               double *storage, double *loss)
{
    const transverse_data *d = material->data;
    transverse_moduli m[CHUNK];
    for (size_t from = 0; from < n; from += CHUNK) {
        const size_t count = n - from < CHUNK ? n - from : CHUNK;
        directional_moduli(d, omega + from, count, m);
        for (size_t i = 0; i < count; i++) {
            const double complex e = d->stiffness / transverse_compliance(&m[i]);
            const bool liquid = isnan(creal(e)); /* a modulus is 0 */
            storage[from + i] = liquid ? 0 : creal(e);
            loss[from + i] = liquid ? 0 : cimag(e);
        }
    }
}

static const double *transverse_breaks(const wt_material *material, size_t *n)
{
    const transverse_data *d = material->data;
    *n = d->n_breaks;
    return d->breaks;
}

/* ---- validity checks ------------------------------------------------------------------------- */

/* Tolerance for a set of moduli at the limit of stability, such as an incompressible one. It is
 * 1000 times the rounding error and far below the accuracy of a modulus. */
static const double slack = 1e-12;

static wt_status fail_unphysical_moduli(const transverse_moduli *m, double omega, const char *what,
                                        const char *expected, wt_error *err)
{
    wt_fail(err, WT_E_RANGE, "the transversely isotropic material is %s at %.3g rad/s", what,
            omega);
    wt_error_expected(err, "%s", expected);
    wt_error_found(err, "nu_p = %g, nu_zp = %g, Ez = (%.3g + %.3g i) Ep, G = (%.3g + %.3g i) Ep",
                   m->plane_poisson, m->axial_poisson, creal(m->axial / m->plane),
                   cimag(m->axial / m->plane), creal(m->shear / m->plane),
                   cimag(m->shear / m->plane));
    wt_error_advice(err, "axial-poisson is nu_zp, the contraction in the plane under a load along "
                         "the normal, not nu_pz = nu_zp Ep/Ez");
    return WT_E_RANGE;
}

/* Checks the moduli at one frequency. *passive: false if some load would gain energy. */
static wt_status check_frequency(const transverse_data *d, double omega, bool *passive,
                                 wt_error *err)
{
    transverse_moduli m;
    directional_moduli(d, &omega, 1, &m);
    double scale;
    const double complex plane = 1 / m.plane, axial = 1 / m.axial,
                         sum = 1 / m.shear + 2 * volume_compliance(&m, &scale);
    const double share = 2 * m.axial_poisson * m.axial_poisson, rest = 1 - m.plane_poisson;
    *passive = true;
    if (!isfinite(creal(sum)) || !isfinite(cimag(sum)))
        return WT_OK; /* the solid is a liquid at rest */
    if (share * creal(axial) > (1 + slack) * rest * creal(plane))
        return fail_unphysical_moduli(&m, omega, "unstable",
                                      "2 nu_zp^2 Re(1/Ez) <= (1 - nu_p) Re(1/Ep)", err);
    if (8 * DBL_EPSILON * scale > slack * cabs(sum))
        return fail_unphysical_moduli(
            &m, omega, "incompressible and too stiff in shear, so singular",
            "a modulus of shear of the size of the others, or smaller Poisson ratios", err);
    *passive = share * -cimag(axial) <= (1 + slack) * rest * -cimag(plane);
    if (cimag(transverse_compliance(&m)) > 0)
        return fail_unphysical_moduli(&m, omega, "a source of energy",
                                      "a loss above 0 at the surface", err);
    return WT_OK;
}

/* Frequencies per decade of the check. One relaxation time is 1.14 decades wide. */
enum { PER_DECADE = 8 };

static wt_status transverse_check(const wt_material *material, double low, double high,
                                  char statement[256], wt_error *err)
{
    const transverse_data *d = material->data;
    /* the integral over the angle always uses lower frequencies */
    const double first = fmax(1e-3 * low, DBL_MIN / DBL_EPSILON);
    const double decades = fmax(0, log10(high / first));
    const size_t steps = 1 + (size_t)(PER_DECADE * decades);
    double from = (double)INFINITY, to = 0;
    wt_status status = WT_OK;
    for (size_t i = 0; status == WT_OK && i <= steps + d->n_breaks; i++) {
        const double omega = i <= steps ? first * pow(10, decades * (double)i / (double)steps)
                                        : d->breaks[i - steps - 1];
        bool passive = true;
        if (omega <= high || i <= steps)
            status = check_frequency(d, omega, &passive, err);
        if (!passive) {
            from = fmin(from, omega);
            to = fmax(to, omega);
        }
    }
    if (statement != NULL)
        statement[0] = '\0';
    if (status == WT_OK && statement != NULL && to > 0)
        clocale_print(statement, 256,
                      "the transversely isotropic material is not passive at frequencies from %.2g "
                      "to %.2g rad/s: its loss along the normal and its Poisson ratios do not go "
                      "together, for some loads would gain energy",
                      from, to);
    return status;
}

/* ---- construction ---------------------------------------------------------------------------- */

static void free_distinct_laws(wt_material *const *law)
{
    for (size_t i = 0; i < N_MODULI; i++) {
        bool freed = false;
        for (size_t k = 0; k < i; k++)
            freed = freed || law[k] == law[i];
        if (!freed)
            wt_material_free(law[i]);
    }
}

static void transverse_free(wt_material *material)
{
    transverse_data *d = material->data;
    free_distinct_laws(d->law);
    free(d->breaks);
    free(d);
}

static const wt_material_law transverse_law = {
    .name = "transverse",
    .modulus = transverse_modulus,
    .breaks = transverse_breaks,
    .check = transverse_check,
    .free = transverse_free,
};

static void merge_breaks(transverse_data *d)
{
    size_t n[N_MODULI] = {0}, all = 0;
    const double *of[N_MODULI] = {NULL};
    for (size_t i = 0; i < N_MODULI; i++) {
        if (d->law[i]->law->breaks != NULL && (i == 0 || d->law[i] != d->law[0]))
            of[i] = d->law[i]->law->breaks(d->law[i], &n[i]);
        all += n[i];
    }
    d->breaks = wt_alloc(all, sizeof *d->breaks);
    for (size_t i = 0; i < N_MODULI; i++)
        for (size_t k = 0; k < n[i]; k++)
            d->breaks[d->n_breaks++] = of[i][k];
    numbers_sort(d->breaks, d->n_breaks);
    size_t kept = 0;
    for (size_t i = 0; i < d->n_breaks; i++)
        if (kept == 0 || d->breaks[i] > d->breaks[kept - 1])
            d->breaks[kept++] = d->breaks[i];
    d->n_breaks = kept;
}

/* Intersects the frequency ranges of all laws. The limits are NaN if no law has limits. */
static void intersect_ranges(const transverse_data *d, double *low, double *high)
{
    *low = *high = (double)NAN;
    for (size_t i = 0; i < N_MODULI; i++) {
        *low = fmax(*low, d->law[i]->frequency_min);
        *high = fmin(*high, d->law[i]->frequency_max);
    }
}

/* Returns true if one law with one Poisson ratio applies in all directions. */
static bool is_isotropic(const transverse_data *d)
{
    const wt_transverse *t = &d->parameters;
    const double factors[] = {t->plane_storage, t->plane_loss,    t->axial_storage,
                              t->axial_loss,    t->shear_storage, t->shear_loss};
    for (size_t i = 0; i < COUNT_OF(factors); i++)
        if (factors[i] < 1 || factors[i] > 1)
            return false;
    return d->law[AXIAL] == d->law[PLANE] && d->law[SHEAR] == d->law[PLANE] &&
           t->axial_poisson >= t->plane_poisson && t->axial_poisson <= t->plane_poisson &&
           t->plane_poisson >= 0 && t->plane_poisson <= 0.5;
}

wt_status wt_material_transverse(wt_material *plane, wt_material *axial, wt_material *shear,
                                 const wt_transverse *transverse, double poisson_ratio,
                                 wt_material **material, wt_error *err)
{
    wt_material *const law[N_MODULI] = {plane, axial != NULL ? axial : plane,
                                        shear != NULL ? shear : plane};
    wt_status status = material_check_poisson(poisson_ratio, err);
    if (plane == NULL || transverse == NULL || material == NULL)
        status = wt_fail(err, WT_E_ARG, "a transversely isotropic material needs a law");
    if (status == WT_OK)
        status = param_check(wt_transverse_params(), transverse, err);
    if (status != WT_OK) {
        free_distinct_laws(law);
        return status;
    }
    transverse_data *d = wt_alloc(1, sizeof *d);
    for (size_t i = 0; i < N_MODULI; i++)
        d->law[i] = law[i];
    d->parameters = *transverse;
    if (isnan(d->parameters.plane_poisson))
        d->parameters.plane_poisson = poisson_ratio;
    if (isnan(d->parameters.axial_poisson))
        d->parameters.axial_poisson = poisson_ratio;
    if (is_isotropic(d)) {
        plane->poisson_ratio = d->parameters.plane_poisson;
        *material = plane;
        free(d);
        return WT_OK;
    }
    d->stiffness = 2 * (1 - poisson_ratio * poisson_ratio);
    double low, high;
    intersect_ranges(d, &low, &high);
    merge_breaks(d);
    *material = material_create(&transverse_law, d, poisson_ratio, low, high);
    return WT_OK;
}
