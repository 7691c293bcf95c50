/* A sliding contact that tests change: a series of three terms on a self-affine road.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_TESTS_SLIDING_FIXTURE_H
#define WT_TESTS_SLIDING_FIXTURE_H

#include "weartrack/friction.h"

static wt_rubber rubber;
static wt_surface surface;
static wt_sliding sliding;
static wt_job work;

static inline void sliding_set_up(const double *velocity, size_t n)
{
    static double tau[] = {1e-6, 1e-4, 1e-2}, term[] = {300e6, 10e6, 3e6};
    rubber = (wt_rubber){.prony = {.deformation = WT_TENSION,
                                   .reference_temperature = 293.15,
                                   .equilibrium_modulus = 3e6,
                                   .n = 3,
                                   .relaxation_time = tau,
                                   .modulus = term,
                                   .frequency_min = 1e-2,
                                   .frequency_max = 1e8},
                         .poisson_ratio = 0.5};
    surface = (wt_surface){.self_affine = true, .q0 = 2e3, .qr = 4e3, .q1 = 2e6, .hurst = 0.8};
    surface.c0 = (wt_estimate){2e-17, 0, 0, "m^4"};
    sliding = wt_sliding_defaults();
    sliding.rubber = &rubber;
    sliding.surface = &surface;
    sliding.pressure.value = 0.4e6;
    sliding.shear_stress.value = 5e6;
    sliding.velocity = velocity;
    sliding.n_velocity = n;
    work = wt_job_defaults();
    work.threads = 1;
}

/* The same at one velocity, with errors of the inputs. */
static inline void sliding_set_up_uncertain(void)
{
    static const double velocity = 0.1;
    sliding_set_up(&velocity, 1);
    sliding.pressure.standard_error = 0.02e6;
    sliding.shear_stress.standard_error = 0.5e6;
}

#endif
