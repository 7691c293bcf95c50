/* The fit of a sweep from start to verdict, and what is made of it (internal to the fit room).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DMA_NUMERICS_MASTER_FIT_H
#define WT_DMA_NUMERICS_MASTER_FIT_H

#include "dma/numerics/overlap_chain.h"
#include "dma/numerics/posterior.h"
#include "dma/numerics/superposition.h"

typedef struct master_work {
    arena memory;
    wt_master_options options;
    shift_set set;
    double reference; /* [K] */
    size_t anchor;
    bool measured_reference; /* the anchor is the reference */
    bool flows;              /* creep of a liquid, that is fitted with an equilibrium modulus */
    double terms_per_decade; /* of the spectrum, as asked or as it needs */
    bool lines;              /* it needs more, for it is one of sharp lines */
    bool *placed;            /* [set.n] */
    double *a, *b;           /* [set.n] decades */
    double *physical;        /* [set.n] decades */
    double *overlap;         /* [set.n] decades */
    size_t *curve;           /* [set.n] in the spectrum; of the posterior */
    wt_posterior *posterior;
    spectrum *s; /* that of the posterior */
    vertical vertical;
    spectrum_prior prior;
    spectrum_within within; /* noise within the isotherms */
    lack_of_fit lack;       /* of one spectrum with shifts of its own */
    bool tested;
    bool plain;            /* no other start, and no shifts by overlaps */
    bool gross;            /* it misses the isotherms by so much that its shifts mean nothing */
    bool louder;           /* and by more than their noise, which chance does not do */
    overlap_link *link;    /* [set.n] by the overlap of neighbours */
    double *own_a;         /* [set.n] those of one spectrum of all [decade], NaN: none */
    double missed[MODULI]; /* what one spectrum is off, in ln */
    wt_shift_route route;
    char no_spectrum[256]; /* why there is none with shifts of its own, or "" */
    bool part;             /* the spectrum is that of the isotherms from `first` to `last`: one of
                              all fails, by `whole` */
    size_t first, last;
    lack_of_fit whole;
    double missed_whole[MODULI]; /* what that is off */
} master_work;

/* tan delta knows no vertical shift, and one modulus does not tell it from the horizontal one. */
wt_status master_check_vertical(master_work *work, wt_error *err) WT_NODISCARD;
wt_status master_work_alloc(master_work *work, wt_error *err) WT_NODISCARD;
/* The isotherm to start from. */
wt_status master_choose_anchor(master_work *work, wt_error *err) WT_NODISCARD;
/* Spectrum and shifts: start, outliers, which isotherms hang together; gross: far off. */
wt_status master_place(master_work *work, wt_error *err) WT_NODISCARD;
wt_status master_find_noise(master_work *work, wt_error *err) WT_NODISCARD;
/* How far the fit is from what is within the isotherms: missed, gross. */
wt_status master_measure_misfit(master_work *work, wt_error *err) WT_NODISCARD;
/* The lack of fit, with free vertical shifts. */
wt_status master_test(master_work *work, wt_error *err) WT_NODISCARD;
/* Noise that is the same all along an isotherm. */
extern const double master_even[SPECTRUM_SHAPES];
/* link: [set.n] the overlaps with the vertical shift of rubber elasticity, or with none. */
wt_status master_links(const master_work *work, bool physical, overlap_link *link,
                       wt_error *err) WT_NODISCARD;
/* The prior of the vertical shifts, with widths of clamping and departure [decade]. */
wt_status master_set_widths(master_work *work, wt_vertical_shift kind, double geometry,
                            double departure, wt_error *err) WT_NODISCARD;
/* All widths that count; the spectrum is left at the best of them. */
wt_status master_fit_widths(master_work *work, wt_error *err) WT_NODISCARD;
/* A spectrum for the placed curves at the shifts as they are, without outliers. */
wt_status master_make_spectrum(master_work *work, wt_error *err) WT_NODISCARD;
wt_status master_fit_robust(master_work *work, wt_error *err) WT_NODISCARD;
/* Fills link with the vertical shifts that go with them. */
wt_status master_overlaps(master_work *work, wt_error *err) WT_NODISCARD;
/* The shifts of the overlaps in the place of those of the spectrum, which is fitted to them. */
wt_status master_by_overlap(master_work *work, wt_error *err) WT_NODISCARD;
/* The shift of an isotherm beside that part, with its error. */
bool master_beside_part(const master_work *work, size_t i, double *a, double *error);
/* Whether the overlaps tell shifts: of storage moduli, and none are given; they are in `link` then.
 */
wt_status master_may_overlap(master_work *work, bool *may, wt_error *err) WT_NODISCARD;
/* Keeps the shifts of the spectrum in own_a. */
void master_keep_original(master_work *work);
/* Where superposition fails: the errors of the shifts of the spectrum hold what the overlaps
 * disagree by, too. */
wt_status master_uncertainty(master_work *work, wt_error *err) WT_NODISCARD;
/* Whether that leaves no shift of the spectrum. */
bool master_all_uncertain(const master_work *work);
/* A shift with a larger error is not determined [decade]. */
extern const double master_largest_sigma;
/* Whether the shifts of the spectrum are what the overlaps say, with the vertical shift of rubber
 * elasticity or with none. */
wt_status master_agrees(const master_work *work, bool *agrees, wt_error *err) WT_NODISCARD;
/* Whether the lack of fit is real and matters. */
bool master_misfit_is_real(const lack_of_fit *lack);
/* Whether superposition is not said to hold for a lack of fit, be it small. */
bool master_misfit_is_likely(const lack_of_fit *lack);
/* Whether a factor on all E'' is real and matters. */
bool master_loss_is_off(const lack_of_fit *lack);
/* Whether it is all that does: it leaves the shifts what they are. */
bool master_is_factor(const lack_of_fit *lack);

/* For the reference of the options. *better: where the fit failed for want of overlap, NaN or the
 * temperature of an isotherm that changes much more than the one it was started from. */
wt_status master_fit_once(const wt_sweep *sweep, const wt_master_options *options, wt_log *log,
                          wt_master *master, double *better, wt_error *err) WT_NODISCARD;
/* Fills `master` (without the posterior, which it takes over). */
wt_status master_report(master_work *work, const wt_sweep *sweep, wt_log *log, wt_master *master,
                        wt_error *err) WT_NODISCARD;
/* The shifts with their notes. */
wt_status master_fill_shifts(const master_work *work, wt_master *m, wt_error *err) WT_NODISCARD;
/* WT_E_RANGE: none can be given for the reference temperature. */
wt_status master_check_reference(const master_work *work, const wt_master *m,
                                 wt_error *err) WT_NODISCARD;
/* WT_E_NO_OVERLAP: no isotherm is shifted onto the reference. */
wt_status master_check_shifts(const master_work *work, const wt_master *m,
                              wt_error *err) WT_NODISCARD;
/* Adds a remark to the note of a shift, parted by "; ". */
void master_note(wt_master_shift *shift, const char *format, ...) WT_PRINTF(2, 3);
/* What is odd about the isotherms, into their notes and the log. */
void master_notes(const master_work *work, const wt_sweep *sweep, wt_master *m, wt_log *log);
/* The verdict on superposition; shifts and test are in `master`. */
void master_assess(const master_work *work, wt_master *master);

#endif
