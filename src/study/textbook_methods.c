/* Friction by the plain textbook method; see the header. */
#include "study/textbook_methods.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

void textbook_angular_integrals(const wt_material *material, double w, size_t n, double *scratch,
                                double *j1, double *j2)
{
    double *omega = scratch, *storage = scratch + n + 1, *loss = scratch + 2 * (n + 1);
    const double step = M_PI_2 / (double)n;
    for (size_t i = 0; i <= n; i++)
        omega[i] = fmax(w * cos((double)i * step), DBL_MIN);
    material->law->modulus(material, omega, n + 1, storage, loss);
    *j1 = 0;
    *j2 = 0;
    for (size_t i = 0; i <= n; i++) {
        const double weight = (i == 0 || i == n ? 1 : i % 2 ? 4 : 2) * step / 3;
        *j1 += 4 * weight * cos((double)i * step) * loss[i];
        *j2 += 4 * weight * (storage[i] * storage[i] + loss[i] * loss[i]);
    }
}

wt_status textbook_friction_compute(const wt_material *material, const wt_roughness *roughness,
                                    double pressure, double velocity, size_t n_q, size_t n_angle,
                                    textbook_friction *result)
{
    if (n_q < 2 || n_angle < 2 || n_angle % 2)
        return WT_E_ARG;
    const bool closed = material->law->angular != NULL;
    double *scratch = wt_alloc(3 * (n_angle + 1), sizeof *scratch);
    const double nu = material->poisson_ratio;
    const double stiffness = 1 / ((1 - nu * nu) * pressure);
    const double step = log(roughness->q1 / roughness->q0) / (double)(n_q - 1);
    textbook_friction r = {0, 1, 0};
    double last_g = 0, last_mu = 0;
    for (size_t i = 0; i < n_q; i++) {
        const double q = fmin(roughness->q0 * exp((double)i * step), roughness->q1);
        double c, j1, j2;
        roughness->law->density(roughness, &q, 1, &c);
        const double w = q * velocity;
        if (closed)
            material->law->angular(material, &w, 1, &j1, &j2);
        else
            textbook_angular_integrals(material, w, n_angle, scratch, &j1, &j2);
        const double g = q * q * q * q * c * stiffness * stiffness * j2 / 8;
        if (i > 0)
            r.stress_variance += step * (last_g + g) / 2;
        if (r.stress_variance > 0)
            r.area_ratio = erf(0.5 / sqrt(r.stress_variance));
        const double mu = q * q * q * q * c * r.area_ratio * stiffness * j1 / 2;
        if (i > 0)
            r.hysteresis += step * (last_mu + mu) / 2;
        last_g = g;
        last_mu = mu;
    }
    free(scratch);
    *result = r;
    return WT_OK;
}
