/* Internal interface of the master curve fit, from start to verdict.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DMA_NUMERICS_MASTER_FIT_H
#define WT_DMA_NUMERICS_MASTER_FIT_H

#include "dma/numerics/isotherm.h"
#include "dma/numerics/posterior.h"
#include "dma/numerics/spectrum.h"

/* Shift of an isotherm by the overlaps on the way to the anchor [decade]. */
typedef struct overlap_edge {
    bool placed;
    size_t onto;    /* index of the placed isotherm it is linked to; the anchor: itself */
    double a;       /* shift relative to the anchor */
    double step;    /* standard error of the step onto it */
    double error;   /* standard error of a for fully correlated steps */
    double spread;  /* additional error of a if only one position of each overlap is right, the same
                       in all */
    double by_loss; /* change of a by the overlaps of the loss modulus alone */
    double by_vertical; /* change of a by the other vertical shifts */
} overlap_edge;

typedef struct master_work {
    arena memory;
    wt_master_options options;
    shift_set set;
    double reference;         /* [K] */
    size_t anchor;            /* isotherm to which the fit refers; it depends on the data only */
    size_t at;                /* isotherm at the reference temperature, or set.n: the law gives the
                                 reference */
    bool is_reference_fitted; /* the isotherms of the spectrum give the reference, at `place` */
    posterior_place place;
    size_t root;             /* isotherm to which the additional errors of the shifts refer */
    double *base_error;      /* [curves] those errors against the anchor, or NULL */
    bool flows;              /* creep of a liquid, fitted with an equilibrium modulus */
    double terms_per_decade; /* stated or chosen number of terms per decade */
    bool lines;              /* the spectrum has sharp lines and needs more terms */
    bool *placed;            /* [set.n] */
    double *a, *b;           /* [set.n] decades */
    double *physical;        /* [set.n] decades */
    double *overlap;         /* [set.n] decades */
    size_t *curve;           /* [set.n] index of a curve in the spectrum; owned by the posterior */
    wt_posterior *posterior;
    spectrum *s; /* frame of the posterior */
    vertical vertical;
    spectrum_prior prior;
    spectrum_isotherm_noise within; /* noise within the isotherms */
    lack_of_fit lack;               /* lack of fit of one spectrum with free shifts */
    bool tested;
    bool plain;            /* no restart and no overlap shifts */
    bool is_gross;         /* the misfit is so large that the shifts are meaningless */
    bool exceeds_noise;    /* and the misfit exceeds the noise */
    overlap_edge *edge;    /* [set.n] shifts by overlap of neighbours */
    double *original_a;    /* [set.n] shifts of one spectrum of all isotherms [decade]; NaN: none */
    double missed[MODULI]; /* misfit of one spectrum [ln] */
    wt_shift_route route;
    char no_spectrum[256]; /* reason why no spectrum with free shifts was found, or "" */
    bool part; /* the spectrum covers the isotherms from `first` to `last`, because one of all
                  isotherms fails */
    size_t first, last;
    lack_of_fit whole;
    double missed_whole[MODULI]; /* misfit of one spectrum of all isotherms [ln] */
} master_work;

/* Adapts the vertical shift to the data, or fails if free vertical shifts cannot be determined. */
wt_status master_check_vertical(master_work *work, wt_error *err) WT_NODISCARD;
void master_work_alloc(master_work *work);
/* Chooses the isotherm to start from: the one nearest to `base` [K], or the middle one for NaN.
 * Stated shifts start from the stated isotherm nearest to the reference. */
wt_status master_choose_anchor(master_work *work, double base, wt_error *err) WT_NODISCARD;
/* Completes the shifts by hand: holds the isotherm that they refer to. Returns WT_E_ARG if that is
 * shifted by hand itself. */
wt_status master_hold_hand_shifts(master_work *work, double base, wt_error *err) WT_NODISCARD;
/* Places the isotherms: start, outliers and connected isotherms. Sets the flag of a gross
 * misfit. */
wt_status master_find_initial_shifts(master_work *work, wt_error *err) WT_NODISCARD;
wt_status master_estimate_noise(master_work *work, wt_error *err) WT_NODISCARD;
/* Measures the misfit beyond the noise within the isotherms and sets its flags. */
void master_measure_misfit(master_work *work);
/* Tests superposition with free vertical shifts; fills `lack`. */
wt_status master_test_superposition(master_work *work, wt_error *err) WT_NODISCARD;
/* Sets the prior of the vertical shifts, with widths of clamping and departure [decade]. */
wt_status master_set_widths(master_work *work, wt_vertical_shift kind, double geometry,
                            double departure, wt_error *err) WT_NODISCARD;
/* Returns true if the spectrum contains the isotherm at the reference temperature. */
static inline bool master_reference_is_fitted(const master_work *work)
{
    return work->at < work->set.n && work->placed[work->at];
}
/* Finds the isotherms of the spectrum around a reference temperature that is none of the isotherms.
 * Returns false if it lies beyond them. */
static inline bool master_reference_neighbours(const master_work *work, size_t *cold, size_t *warm)
{
    const size_t n = work->set.n;
    *cold = *warm = n;
    for (size_t i = 0; i < n && *warm == n; i++)
        if (work->placed[i])
            *(work->set.curves[i].temperature <= work->reference ? cold : warm) = i;
    return work->at == n && *cold < n && *warm < n;
}
/* Places the reference temperature at or between the isotherms of the spectrum. */
void master_place_reference(master_work *work);
/* Computes log_a [set->n], in decades, 0 at the anchor. It is NaN if no isotherm towards the
 * anchor shares enough height, or without a storage modulus. */
void closed_form_shifts(const shift_set *set, size_t anchor, double *log_a);
/* Fills the edges of the work from the overlaps with the requested vertical shifts. */
void master_find_overlaps(master_work *work);
/* Replaces the shifts by those of the overlaps and fits the spectrum to them. */
wt_status master_use_overlap_shifts(master_work *work, wt_error *err) WT_NODISCARD;
/* Computes the shift, against the anchor, and error of an isotherm outside the described part. */
bool master_shift_outside_part(const master_work *work, size_t i, double *a, double *error);
/* Returns true if the overlaps determine shifts. They need storage moduli and no stated shift. The
 * function also fills the edges of the work. */
bool master_can_use_overlaps(master_work *work);
/* Stores the shifts of the spectrum in original_a. */
void master_store_original_shifts(master_work *work);
/* Refers overlaps and additional errors of the shifts to the isotherm of the reference temperature.
 */
void master_refer_errors(master_work *work);
/* Sets the additional errors of the shifts. */
void master_set_shift_errors(master_work *work);
/* Adds the disagreement with the overlaps to the errors of the shifts if superposition fails. */
void master_uncertainty(master_work *work);
/* Returns true if no shift of the spectrum remains determined. */
bool master_all_uncertain(const master_work *work);
/* A shift with a larger error is not determined [decade]. */
extern const double master_max_shift_error;
/* Returns true if the shifts of the spectrum agree with the overlaps, with the vertical shift of
 * rubber elasticity or with none. */
bool master_shifts_agree(const master_work *work);
/* Returns true if the lack of fit is significant and relevant. */
bool master_misfit_is_significant(const lack_of_fit *lack);
/* Returns true if a lack of fit is likely, which prevents the verdict that superposition holds. */
bool master_misfit_is_likely(const lack_of_fit *lack);
/* Returns true if a common factor on all E'' is significant and relevant. */
bool master_loss_is_inconsistent(const lack_of_fit *lack);
/* Returns true if that factor is the only misfit. It does not affect the shifts. */
bool master_misfit_is_loss_factor(const lack_of_fit *lack);

/* Returns true if one spectrum does not describe the placed isotherms. */
bool master_misfits(const master_work *work);
/* Finds the one isotherm whose E'' objects to both neighbours while all others agree, and writes
 * the reason. Returns false if there is none. */
bool master_find_objecting(master_work *work, size_t *found);
/* Finds an isotherm whose frequencies are off by 2 pi, and writes the reason. Returns false if
 * there is none. */
bool master_find_unit_slip(master_work *work, size_t *found);

/* Fits all relevant widths of the vertical shift. The spectrum ends at the best one. */
wt_status master_fit_widths(master_work *work, wt_error *err) WT_NODISCARD;

/* Fills `master` and transfers the posterior to it. */
wt_status master_report(master_work *work, const wt_sweep *sweep, wt_log *log, wt_master *master,
                        wt_error *err) WT_NODISCARD;
/* Returns log10 a of the isotherm at the reference temperature against the anchor, 0 without one.
 */
double master_reference_shift(const master_work *work);
/* Fills the shifts and their notes. */
void master_fill_shifts(const master_work *work, wt_master *m);
/* Returns WT_E_RANGE if no shift exists for the reference temperature. */
wt_status master_check_reference(const master_work *work, const wt_master *m,
                                 wt_error *err) WT_NODISCARD;
/* Returns WT_E_NO_OVERLAP if no isotherm is shifted onto the reference. */
wt_status master_check_shifts(const master_work *work, const wt_master *m,
                              wt_error *err) WT_NODISCARD;
/* Returns the isotherm with the largest change of modulus if its shift error is at most half of
 * that of the anchor, otherwise the anchor. */
size_t master_steeper_isotherm(const master_work *work);
/* Appends a remark to the note of a shift after "; ". */
void master_add_note(wt_master_shift *shift, const char *format, ...) WT_PRINTF(2, 3);
/* Writes unexpected properties of the isotherms to their notes and to the log. */
void master_add_notes(const master_work *work, const wt_sweep *sweep, wt_master *m, wt_log *log);
/* Sets the verdict on superposition. The shifts and the test must be complete. */
void master_assess(const master_work *work, wt_master *master);

#endif
