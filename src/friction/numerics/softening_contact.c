/* Strain softening of the moduli (Payne effect): Lorenz, Oh, Nam, Jeon and Persson, J. Chem. Phys.
 * 142 (2015) 194701. The strain at a wavenumber follows from the running rms slope.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "friction/numerics/softening_contact.h"
#include "friction/numerics/friction_kernel.h"

#include "core/base/param.h"
#include "core/math/root.h"
#include "weartrack/surface.h"

#include <math.h>

/* ---- the loss modulus alone ------------------------------------------------------------------ */

static const wt_material *source_material(const wt_material *loss)
{
    const strain_law *s = loss->data;
    return s->source;
}

static void loss_modulus(const wt_material *material, const double *omega, size_t n,
                         double *storage, double *loss)
{
    const wt_material *source = source_material(material);
    source->law->modulus(source, omega, n, storage, loss);
    for (size_t i = 0; i < n; i++)
        storage[i] = 0;
}

static const double *loss_breaks(const wt_material *material, size_t *n)
{
    const wt_material *source = source_material(material);
    *n = 0;
    return source->law->breaks != NULL ? source->law->breaks(source, n) : NULL;
}

/* J1 is not computed here; it is read from the complete material. */
static void loss_angular(const wt_material *material, const double *omega, size_t n, double *j1,
                         double *j2)
{
    const wt_material *source = source_material(material);
    source->law->angular_loss(source, omega, n, j2);
    for (size_t i = 0; i < n; i++)
        j1[i] = 0;
}

/* The closed form is a double sum. */
static size_t loss_terms(const wt_material *material)
{
    const wt_material *source = source_material(material);
    const size_t n = source->law->terms != NULL ? source->law->terms(source) : 1;
    return n * n;
}

static const wt_material_law loss_law = {
    .name = "loss", .modulus = loss_modulus, .breaks = loss_breaks};
static const wt_material_law loss_law_closed = {.name = "loss",
                                                .modulus = loss_modulus,
                                                .breaks = loss_breaks,
                                                .angular = loss_angular,
                                                .terms = loss_terms};

/* ---- strain ---------------------------------------------------------------------------------- */

/* Below this t the rounding of q matters; above it the relative error is ten roundings. */
static const double rounding_counts = 0.1;

/* Strain at a wavenumber. */
static double softening_strain(const strain_law *s, double q)
{
    return s->factor * sqrt(2 * M_PI * wt_roughness_moment(s->roughness, 3, q));
}

/* Strain at q = q0 e^t. Near q0 a rounded q loses digits of t; the square of the strain is
 * proportional to t there. */
static double running_strain(const strain_law *s, double q, double t)
{
    const double rounded = log1p((q - s->roughness->q0) / s->roughness->q0);
    return softening_strain(s, q) * (rounded > 0 && t < rounding_counts ? sqrt(t / rounded) : 1);
}

/* Returns the last point of the table at or below ln eps, or n. */
static size_t preceding_point(const strain_law *s, double log_strain)
{
    size_t low = 0, high = s->n;
    while (low < high) {
        const size_t middle = (low + high) / 2;
        if (s->log_strain[middle] <= log_strain)
            low = middle + 1;
        else
            high = middle;
    }
    return low > 0 ? low - 1 : s->n;
}

void softening_factors(const strain_law *s, const double *q, const double *t, size_t n, double *f,
                       double *g)
{
    for (size_t i = 0; i < n; i++) {
        const double x = log(running_strain(s, q[i], t[i]));
        const size_t before = preceding_point(s, x);
        const size_t k = before == s->n ? 0 : before;
        f[i] = s->f[k];
        g[i] = s->g[k];
        if (before + 1 >= s->n)
            continue;
        const double part = (x - s->log_strain[k]) / (s->log_strain[k + 1] - s->log_strain[k]);
        f[i] += part * (s->f[k + 1] - s->f[k]);
        g[i] += part * (s->g[k + 1] - s->g[k]);
    }
}

/* ---- construction ---------------------------------------------------------------------------- */

typedef struct strain_crossing {
    const strain_law *s;
    double strain;
} strain_crossing;

static double strain_excess(double t, void *user)
{
    const strain_crossing *m = user;
    const wt_roughness *r = m->s->roughness;
    const double ratio = running_strain(m->s, fmin(r->q0 + r->q0 * expm1(t), r->q1), t) / m->strain;
    return ratio * ratio - 1;
}

static wt_status find_strain_cuts(strain_law *s, arena *memory, wt_error *err)
{
    const wt_roughness *r = s->roughness;
    const double length = log1p((r->q1 - r->q0) / r->q0);
    s->cuts = arena_numbers(memory, s->n);
    double from = 0;
    for (size_t k = 0; k < s->n; k++) {
        strain_crossing m = {.s = s, .strain = exp(s->log_strain[k])};
        if (!(strain_excess(length, &m) > 0))
            break;
        const bool met = strain_excess(from, &m) < 0; /* otherwise the strain is reached at the
                                                        smallest representable t */
        const wt_status status =
            met ? root_find(strain_excess, &m, from, length, 0, &from, err) : WT_OK;
        if (status != WT_OK)
            return status;
        const double q = fmin(r->q0 + r->q0 * expm1(from), r->q1);
        if (k == 0)
            s->range[0] = q;
        if (k + 1 == s->n)
            s->range[1] = q;
        if (!met)
            continue;
        if (s->n_cuts == 0 || from > s->cuts[s->n_cuts - 1])
            s->cuts[s->n_cuts++] = from;
    }
    return WT_OK;
}

wt_status softening_new(const wt_softening *table, double factor, const wt_material *material,
                        const wt_roughness *roughness, arena *memory, strain_law **made,
                        wt_error *err)
{
    const wt_status status = wt_softening_check(table, err);
    if (status != WT_OK)
        return status;
    strain_law *s = arena_alloc(memory, 1, sizeof *s);
    double *numbers = arena_numbers(memory, 3 * table->n);
    *s = (strain_law){.roughness = roughness,
                      .factor = factor,
                      .n = table->n,
                      .log_strain = numbers,
                      .f = numbers + table->n,
                      .g = numbers + 2 * table->n,
                      .cancellation = 1,
                      .range = {roughness->q1, roughness->q1},
                      .source = material,
                      .loss = *material};
    s->loss.law = material->law->angular_loss != NULL ? &loss_law_closed : &loss_law;
    s->loss.data = s;
    s->loss.frequency_min = s->loss.frequency_max = (double)NAN;
    for (size_t k = 0; k < s->n; k++) {
        s->log_strain[k] = log(table->strain[k]);
        const double f = s->f[k] = table->storage[k], g = s->g[k] = table->loss[k];
        if (f > g)
            s->cancellation = fmax(s->cancellation, 2 * (f / g) * (f / g) - 1);
        if (k == 0)
            continue;
        const double by = s->log_strain[k] - s->log_strain[k - 1];
        const double least = fmin(fmin(f, s->f[k - 1]), fmin(g, s->g[k - 1]));
        s->steepest =
            fmax(s->steepest, fmax(fabs(f - s->f[k - 1]), fabs(g - s->g[k - 1])) / (by * least));
    }
    *made = s;
    return find_strain_cuts(s, memory, err);
}

/* ---- public functions ------------------------------------------------------------------------ */

void wt_friction_strain_range(const wt_friction_workspace *workspace, double range[2])
{
    const strain_law *s = workspace != NULL ? workspace->softening : NULL;
    for (size_t i = 0; i < 2; i++)
        range[i] = s != NULL ? s->range[i] : (double)NAN;
}

double wt_friction_strain(const wt_friction_workspace *workspace, double wavenumber)
{
    if (workspace == NULL || workspace->softening == NULL ||
        !(wavenumber >= workspace->roughness->q0 && wavenumber <= workspace->roughness->q1))
        return (double)NAN;
    return softening_strain(workspace->softening, wavenumber);
}
