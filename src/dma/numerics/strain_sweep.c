/* Strain softening of a filled rubber, as measured in one strain sweep.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "weartrack/dma.h"

#include "core/base/array.h"

#include <math.h>
#include <stdlib.h>

typedef struct strain_points {
    size_t n;
    const double *log_strain, *storage, *loss;
} strain_points;

/* END points are averaged at each end. A largest value among the outer two points is no maximum. */
enum { END = 3, FROM_END = 2 };
/* Strain range of the points that are averaged at the start: half a decade. A law of Kraus (1984)
 * falls there by (start_ratio gamma / gamma_c)^(2 m), less for a smaller first amplitude. */
static const double start_ratio = 3;
/* Fractions of the initial modulus whose strains are reported: onset of softening and half. */
static const double tenth_lost = 0.9, half_lost = 0.5;

static double crossing_strain(const strain_points *p, double to)
{
    const double *x = p->log_strain, *y = p->storage;
    for (size_t i = 1; i < p->n; i++)
        if (y[i] < to && y[i - 1] >= to)
            return exp(x[i - 1] + (x[i] - x[i - 1]) * (y[i - 1] - to) / (y[i - 1] - y[i]));
    return (double)NAN;
}

static void measure_softening(const strain_points *p, wt_payne *payne)
{
    size_t first = 1, top = 0;
    while (first < END && first < p->n &&
           p->log_strain[first] - p->log_strain[0] <= log(start_ratio))
        first++;
    const size_t last = p->n < END ? p->n : END;
    payne->storage_start = numbers_mean(p->storage, first);
    payne->loss_start = numbers_mean(p->loss, first);
    payne->storage_end = numbers_mean(p->storage + p->n - last, last);
    payne->strain_tenth = crossing_strain(p, tenth_lost * payne->storage_start);
    payne->strain_half = crossing_strain(p, half_lost * payne->storage_start);
    for (size_t i = 1; i < p->n; i++)
        if (p->loss[i] > p->loss[top])
            top = i;
    payne->loss_max = p->loss[top];
    if (top >= FROM_END && top + FROM_END < p->n)
        payne->strain_loss_max = exp(p->log_strain[top]);
    else
        payne->loss_note = top < FROM_END
                               ? "largest at the smallest amplitudes: no maximum in range"
                               : "largest at the largest amplitudes: no maximum in range";
}

wt_status wt_payne_measure(const double *strain, const double *storage, const double *loss,
                           size_t n, wt_payne *payne, wt_error *err)
{
    const double nan = (double)NAN;
    const bool storage_only = loss == NULL;
    loss = storage_only ? storage : loss; /* placeholder; its results are set to NaN below */
    if (strain == NULL || storage == NULL || payne == NULL || n == 0)
        return wt_fail(err, WT_E_ARG, "no strain sweep");
    for (size_t i = 0; i < n; i++)
        if (!(strain[i] > 0 && storage[i] > 0 && loss[i] > 0 && isfinite(strain[i]) &&
              isfinite(storage[i]) && isfinite(loss[i]) && (i == 0 || strain[i] >= strain[i - 1])))
            return wt_fail(err, WT_E_ARG, "strain sweep: not rising, or not above zero");
    double *log_strain = wt_alloc(n, sizeof *log_strain);
    for (size_t i = 0; i < n; i++)
        log_strain[i] = log(strain[i]);
    *payne = (wt_payne){.strain_loss_max = nan, .loss_note = ""};
    measure_softening(&(strain_points){n, log_strain, storage, loss}, payne);
    if (storage_only) {
        payne->loss_start = payne->loss_max = payne->strain_loss_max = nan;
        payne->loss_note = "no loss modulus was measured";
    }
    free(log_strain);
    return WT_OK;
}
