/* Prony series from points (internal to the fit room). SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_FIT_PRONY_H
#define WT_FIT_PRONY_H

#include "weartrack/fit.h"

/* Points of a relaxation spectrum: log10 w [rad/s] and log10 moduli [Pa]. */
typedef struct prony_points {
    size_t n;
    const double *log_frequency;
    const double *log_storage;
    const double *log_loss;  /* NULL: the storage modulus alone is fitted */
    double log_min, log_max; /* range of frequencies that sets the relaxation times */
} prony_points;

/* All points of a master curve, which has some. */
prony_points prony_points_of(const wt_master_curve *master);
/* Fits; allocates the series (moduli, times, range; not temperature and deformation). */
wt_status prony_fit_points(const prony_points *points, const wt_prony_options *options,
                           wt_prony *prony, wt_error *err) WT_NODISCARD;
/* log10 E', log10 E'' of the series at log10 w; -inf where the series gives 0. */
void prony_log_moduli(const wt_prony *prony, double log_frequency, double *log_storage,
                      double *log_loss);
/* Rms relative misfit of E'' predicted from a non-negative series fitted to E' alone, half a decade
 * inside the ends (E'' there hangs on E' beyond) and where tan delta > 0.1 (below it E' knows E''
 * no better than its own noise); NaN if there are no such points. */
wt_status prony_kramers_kronig(const prony_points *points, double *misfit,
                               wt_error *err) WT_NODISCARD;

#endif
