/* weartrack - fit room: from force curves to moduli and their comparison; from DMA sweeps to shift
 * factors, their law, master curve and Prony series.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WEARTRACK_FIT_H
#define WEARTRACK_FIT_H

#include "weartrack/model.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- one force curve: baseline, contact point, modulus --------------------------------------- */

/* What becomes of a curve. One list: identifier, words. Accepted and doubtful ones have a modulus
 * to go on with. Tested in about this order; the first that applies is given, with its numbers:
 *   not_finite         more than 10 % of the samples are missing
 *   too_short          fewer than 32 different samples, or than 8 in contact
 *   no_approach        the height does not go one way; the force falls along the segment
 *   saturated          the force stands still while the piezo goes on, or bends down at its top
 *                      (a force of contact rises ever steeper; one false alarm in 1000), and what
 *                      lies below has no modulus; else that one, doubtful
 *   rigid              the tip advances less than 2 % of the bending of the lever, or 1 % of
 *                      sensitivity would change the modulus by more than 50 %
 *   negative_modulus, no_contact   no contact point gives a positive modulus; the largest force is
 *                      less than 5 times the noise
 *   no_baseline        contact before the first sample; baseline of fewer than 10 samples
 * A standard error of more than largest_error of the modulus, most of whose square is
 *   ambiguous_contact  that of a second contact point that is as likely
 *   adhesive           a misfit, with a snap-on or a pull-off
 *   disturbed_baseline a misfit, with a bent baseline (chance below 1 %)
 *   poor_fit           another misfit; or no convergence
 *   imprecise          noise
 * A modulus, but
 *   doubtful           deeper than one radius of a sphere, or than the law of a thin sample holds;
 * a punch that loses work; a misfit (least_chance) that gives the modulus an error of more than
 * doubtful_error; a wave on the baseline of more than 10 % of the largest force, peak to peak
 * And, said by no fit: excluded, unreadable. */
#define WT_CURVE_VERDICT_LIST(X)                                                                   \
    X(WT_CURVE_ACCEPTED, "accepted", "accepted")                                                   \
    X(WT_CURVE_DOUBTFUL, "doubtful", "a modulus to which a misfit gives a large error")            \
    X(WT_CURVE_NO_APPROACH, "no_approach", "the curve has no approach segment")                    \
    X(WT_CURVE_TOO_SHORT, "too_short", "too few samples for a fit")                                \
    X(WT_CURVE_NO_BASELINE, "no_baseline", "starts in contact: no baseline before it")             \
    X(WT_CURVE_NO_CONTACT, "no_contact", "never touches: the force does not leave the baseline")   \
    X(WT_CURVE_SATURATED, "saturated", "detector saturated: flat top of the force")                \
    X(WT_CURVE_NOT_FINITE, "not_finite", "samples are missing or not numbers")                     \
    X(WT_CURVE_POOR_FIT, "poor_fit", "the model does not describe the curve")                      \
    X(WT_CURVE_AMBIGUOUS, "ambiguous_contact", "two contact points describe the curve alike")      \
    X(WT_CURVE_NEGATIVE, "negative_modulus", "the modulus is not positive")                        \
    X(WT_CURVE_DRIFT, "disturbed_baseline", "the baseline is bent or oscillates")                  \
    X(WT_CURVE_RIGID, "rigid", "no indentation: sample too stiff, or calibration wrong")           \
    X(WT_CURVE_ADHESIVE, "adhesive", "adhesion that the contact law does not describe")            \
    X(WT_CURVE_IMPRECISE, "imprecise", "the modulus is too uncertain")                             \
    X(WT_CURVE_EXCLUDED, "excluded", "left out by hand")                                           \
    X(WT_CURVE_UNREADABLE, "unreadable", "the curve could not be read")

typedef enum wt_curve_verdict {
#define WT_CURVE_ENUM(name, id, text) name,
    WT_CURVE_VERDICT_LIST(WT_CURVE_ENUM)
#undef WT_CURVE_ENUM
} wt_curve_verdict;
WT_API const char *wt_curve_verdict_id(wt_curve_verdict verdict);   /* static */
WT_API const char *wt_curve_verdict_text(wt_curve_verdict verdict); /* static */
/* Is its modulus one to go on with: accepted or doubtful? The same of an identifier. */
WT_API bool wt_curve_usable(wt_curve_verdict verdict);
WT_API bool wt_curve_usable_id(const char *id);

enum { WT_CURVE_WAVES = 6 };

/* Estimators of the contact point, as other programs have them, for comparison. */
typedef enum wt_contact_estimator {
    WT_CONTACT_THRESHOLD, /* the force departs from the mean of the first tenth of the samples by
                             twice what they do at most (nanite: deviation from baseline) */
    WT_CONTACT_VARIANCES, /* largest ratio of the variances of a twentieth of the samples behind and
                             before (Gavara, Sci. Rep. 6 (2016) 21267); none where all before are
                             the same */
    WT_CONTACT_LINES,     /* a constant and a line that meet (nanite: fit constant line) */
    WT_CONTACT_DIRECT_PATH,     /* farthest from the straight way between first sample and strongest
                                   force (nanite: Frechet direct path) */
    WT_CONTACT_GOODNESS_OF_FIT, /* least squares of force against indentation as measured, over
                                   baseline and contact (AtomicJ: goodness of fit) */
    WT_CONTACT_ESTIMATORS
} wt_contact_estimator;
WT_API const char *wt_contact_estimator_text(wt_contact_estimator estimator); /* static */

typedef struct wt_indent_options {
    double poisson_ratio; /* default 0.5 */
    /* The range of the fit: all limits that are set hold, forces are above the baseline, and the
     * baseline before contact is always in the fit. */
    double fit_depth;          /* only indentations up to this [m]; 0 = all (default) */
    double fit_force_fraction; /* only forces up to this share of the largest; default 1 */
    bool fit_tilt;             /* baseline tilt is fitted, else offset only; default true */
    bool contact_estimators;   /* also contact points by other estimators, for comparison */
    double least_chance;  /* that noise like that of the baseline leaves a larger residual; below it
                             it is a misfit; default 0.01; 0: none is looked for */
    double largest_error; /* standard error over modulus, above it no modulus; default 0.5, at which
                             the 95 % interval reaches twice the modulus */
    double fixed_contact_point; /* [m] tip position, NaN = fitted (default) */
    /* Default false: the force is compared with that of lever and sample together at the height of
     * the sample, which is where the noise of the force belongs. true: with the force at the
     * measured indentation, as most programs do, for comparison with them; biased where the contact
     * is much stiffer than the lever. */
    bool plain_least_squares;
    /* Relaxation spectrum of the rubber in Young's moduli at the temperature of the curve,
     * borrowed; NULL (default): not known. With it a factor on it is fitted by the hereditary
     * integral, and the modulus is that factor times |E*| at 1/load_time. */
    const wt_prony *spectrum;
    double fit_radii;               /* only indentations up to so many radii of the tip; 0 = all */
    double fit_force;               /* only forces up to this [N]; 0 = all */
    double fit_depth_from;          /* of the contact only indentations from this on [m] */
    double fit_force_from;          /* and forces from this on [N] */
    double fit_force_fraction_from; /* and from this share of the largest on */
    double doubtful_error; /* of a misfit, over the modulus: above it DOUBTFUL; default 0.05 */
    bool fit_retract;      /* also a contact law to the retract alone, as a check; default false */
} wt_indent_options;
WT_API wt_indent_options wt_indent_defaults(void);
WT_API const wt_params *wt_indent_params(void);

/* Result of one curve. Positions are tip positions [m] = height - deflection along the approach,
 * turned to rise into the sample, with the deflection free of the baseline (which is not a bending
 * of the lever). So the contact point is the height at which the tip touches with the lever
 * straight, and with z = direction * height - contact_point and the force above the baseline f =
 * force - baseline_offset - baseline_tilt z the indentation is z - f/k. Model: f = modulus/(1 -
 * nu^2) G(indentation). */
typedef struct wt_indent_fit {
    wt_curve_verdict verdict;
    char reason[160];    /* verdict with its numbers; of an accepted
                            curve what is odd: snap-on left out, missing samples */
    wt_estimate modulus; /* E [Pa]; standard error includes baseline, contact point, the colour
                            of the noise, a bent baseline and misfit_error; of every
                            verdict of a curve that was fitted */
    wt_estimate contact_point;   /* [m] */
    wt_estimate baseline_offset; /* [N] at the contact point */
    wt_estimate baseline_tilt;   /* [N/m] */
    double noise;                /* standard deviation of the baseline residual [N] */
    double correlation_length;   /* of the noise, for waves as long as the contact [samples] */
    double lack_of_fit;          /* slow part of the residual in contact, over the variance that the
                                    noise of the baseline gives it: 1 if the law is right; NaN where
                                    the baseline is too short to say */
    double lack_of_fit_p;        /* of more by noise alone */
    double baseline_p;           /* that a straight baseline departs as much from a line */
    double bend_shift;           /* what the same bend in contact adds to E [Pa]; 0: a baseline that
                                    is straight, as far as its noise tells */
    double misfit[WT_CURVE_WAVES]; /* cosines of the residual over the contact, of max_force */
    double max_force;              /* [N] above the baseline */
    double max_indentation;        /* [m] */
    double adhesion_force; /* pull of the snap-on [N], 0 if none stands out of the baseline */
    wt_estimate work_of_adhesion; /* of the approach [J/m^2]; NaN: fitted without adhesion */
    double pull_off_force;        /* of the retract [N], 0 if none stands out; NaN: no retract */
    double pull_off_work;     /* the work of adhesion that it takes [J/m^2], an upper bound; NaN on
                          a thin sample and where none from 1e-9 to 1e3 makes it */
    wt_estimate contact_pull; /* constant force of a contact with adhesion of long range (DMT, a
                                 capillary) [N]; NaN: fitted without */
    double tabor_number;      /* of the larger work */
    double loss; /* work not given back by the retract, of that of the approach; NaN: no retract */
    double loss_bias;  /* what a fit without memory has more, of the modulus, which then is |E*| at
                          1/loading time; 0: the way in shows no memory; NaN: no loss, no power that
                          is known, a fit with a spectrum or adhesion */
    double piezo_rate; /* [m/s], NaN if no time */
    double indentation_rate;     /* mean of the contact part [m/s], NaN if no time */
    double load_time;            /* contact to end of what is fitted [s], NaN if no time */
    double second_minimum_ratio; /* cost of the second best contact point / best; NaN if none */
    double second_contact_point; /* [m], NaN if none */
    double sensitivity_gain; /* d ln E / d ln sensitivity of this fit, contact point and baseline
                                fitted anew: 15.6 means 1 % gives 15.6 %. Of a single point at
                                known contact it would be 1 + (contact stiffness)/k */
    double misfit_error;     /* what the law misses, in the standard error of the modulus [Pa] */
    double contact_misfit_error; /* and in that of the contact point [m] */
    double baseline_length;      /* travel of the piezo before contact [m] */
    double misfit_length;        /* and what `misfit` is over, to the end [m] */
    wt_estimate spectrum_factor; /* modulus over |E*| of the spectrum; NaN without one, or times */
    double direction;            /* +1: the height rises into the sample, -1: it falls */
    size_t contact_index;        /* sample of the contact point in the approach */
    size_t n_fitted;             /* samples used */
    double
        loss_power; /* of time, of the memory that loses as much and is in the fit; as loss_bias */
    /* of the modulus: what is added to that of the power, and the error of it, which all curves of
     * one rubber share */
    double loss_shift, loss_error;
    double baseline_curvature;                /* the square of the position in it [N/m^2] */
    double contact_by[WT_CONTACT_ESTIMATORS]; /* less contact_point [m]; NaN: not asked for, or
                                                 none found */
    double fitted_from; /* indentation at which the range of the fit begins [m]; 0: contact */
    /* Of a sine that the baseline shows (one false alarm in 1000 baselines), fitted with all else
     * and in their errors: amplitude [N], 0: none; period [m], NaN: none. Its phase is that of the
     * tip or of the height, as the contact says; where that does not tell, the error holds both. */
    double interference_amplitude, interference_period;
    /* Of an elastic contact fitted to the retract alone: modulus [Pa] with its error, and the
     * adhesion of the law that fits it better, either of both; all NaN: not asked for, no retract
     * that comes free, no minimum. */
    wt_estimate retract_modulus, retract_work, retract_pull;
} wt_indent_fit;

/* Scratch for curves of any length; one per thread. */
typedef struct wt_indent_workspace wt_indent_workspace;
WT_API wt_indent_workspace *wt_indent_workspace_new(void);
WT_API void wt_indent_workspace_free(wt_indent_workspace *workspace);

/* Fits one approach: height [m] (piezo extension; the direction is found from the data), force [N],
 * time [s] or NULL, n samples in the order of time, spring constant [N/m]. A curve that cannot be
 * fitted is not an error: WT_OK with its verdict. WT_E_ARG for n = 0 or a spring constant <= 0.
 * options NULL = wt_indent_defaults(). */
WT_API wt_status wt_indent_fit_curve(const wt_contact_table *table,
                                     const wt_indent_options *options, const double *height,
                                     const double *force, const double *time, size_t n,
                                     double spring_constant, wt_indent_workspace *workspace,
                                     wt_indent_fit *fit, wt_error *err) WT_NODISCARD;
/* The same from a force curve as it was read. */
WT_API wt_status wt_indent_force_curve(const wt_contact_table *table,
                                       const wt_indent_options *options,
                                       const wt_force_curve *curve, wt_indent_workspace *workspace,
                                       wt_indent_fit *fit, wt_error *err) WT_NODISCARD;
/* Indentation delta [m] and baseline-free force [N] of the samples from contact on, for plots.
 * delta, force: [n]; returns how many. */
WT_API size_t wt_indent_curve(const wt_indent_fit *fit, const double *height, const double *force,
                              size_t n, double spring_constant, double *delta, double *out_force);

/* The mean residual of curves of one tip and depth against the scatter between them: what one noisy
 * curve hides. */
typedef struct wt_curve_pool {
    size_t n;
    double misfit; /* root mean square over the contact, of the largest force */
    double chance; /* that scatter alone makes more of it; NaN with fewer than 12 curves */
} wt_curve_pool;
/* misfit: that of each fit. */
WT_API wt_curve_pool wt_curve_pool_make(const double (*misfit)[WT_CURVE_WAVES], size_t n);

/* The modulus against depth, from the residuals of curves of one tip, lever and depth with one
 * contact point each, of which a fit with one modulus hides most. */
typedef struct wt_depth_curve {
    double modulus, depth, spring_constant; /* of the fit; the largest indentation */
    double baseline, window; /* travel of the piezo before contact, and of the misfit [m] */
    double misfit[WT_CURVE_WAVES];
    long spot;
    double curvature;  /* of the baseline, which may go on in contact [N/m^2] */
    double loss_error; /* of the modulus, shared by all; NaN: loss whose bias is not known */
} wt_depth_curve;

#define WT_DEPTH_MARGIN 0.1 /* a relative change that does not matter */
typedef enum wt_depth_verdict {
    WT_DEPTH_CANNOT_SAY,
    WT_DEPTH_SAME,      /* the whole interval of the change is within the margin */
    WT_DEPTH_CHANGES,   /* p < 0.01 */
    WT_DEPTH_OTHERWISE, /* there is a residual, but not that of a modulus that changes with depth */
} wt_depth_verdict;

enum { WT_DEPTHS = 5 };
typedef struct wt_curve_depth {
    size_t n, n_units; /* curves; spots, or curves where fewer than three spots are */
    bool by_spot;
    wt_depth_verdict verdict;
    double depth[WT_DEPTHS]; /* equal steps to the largest [m] */
    wt_interval
        modulus[WT_DEPTHS]; /* of the rubber that would give that force at that depth alone */
    wt_interval change;     /* the last over the first */
    double chance;          /* of a larger change by scatter alone */
    double misfit_p;        /* of a larger residual of another shape */
    /* If a layer thinner than the indentation makes the change; NaN where the curves do not tell
     * all three. */
    wt_interval layer_modulus, ground_modulus, thickness;
    size_t n_lossy; /* curves left out, for what loss does to them is not known; as many as the
                       others: nothing is said */
    double bend_share, loss_share; /* of the variance of the change */
} wt_curve_depth;
/* As many degrees of freedom of scatter as cosines of the residual. */
enum { WT_DEPTH_LEAST_CURVES = 2 * WT_CURVE_WAVES };
/* Fewer curves cannot say. The intervals hold what a bend that the baselines have in common
 * does if it goes on in contact, and the error of the memory that stands for loss. */
WT_API wt_status wt_curve_depth_make(const wt_contact_table *table, double poisson_ratio,
                                     const wt_depth_curve *curve, size_t n, wt_curve_depth *depth,
                                     wt_error *err) WT_NODISCARD;

/* What the curves of the track alone say of the thickness of a layer on rubber like the bulk. A
 * thickness is allowed if the curves change with depth as a layer of it would make them, which is
 * on the bulk and has the ratio of the moduli; what the curves of the bulk change by is taken off,
 * so that a tip, loss or a piezo that both share do not count. */
enum { WT_LAYER_STEPS = 96 };
typedef enum wt_layer_bound_kind {
    WT_ALLOWS_UNKNOWN, /* curves of track or bulk: nothing is known */
    WT_ALLOWS_BEYOND,  /* a thick layer of that ratio is one of which the law is not known */
    WT_ALLOWS_ANY,     /* every thickness down to `least` is allowed */
    WT_ALLOWS_THICKER, /* there is a lower end alone */
    WT_ALLOWS_THINNER, /* there is an upper end alone */
    WT_ALLOWS_BETWEEN, /* both */
    WT_ALLOWS_NONE,    /* no thickness makes such curves */
} wt_layer_bound_kind;
typedef struct wt_layer_profile {
    wt_layer_bound_kind says;
    size_t n[2], n_units[2];      /* curves and units of bulk and track */
    double depth, contact_radius; /* mean of the track at the largest indentation [m] */
    double least;                 /* thickness to which the law of a layer reaches [m] */
    bool below;                   /* nothing is known of thinner ones, which are allowed then */
    /* Interval of 95 % [m]: low 0, high infinity: no such end; value NaN but between two ends. */
    wt_interval thickness;
    size_t n_steps; /* from thick to thin: */
    double log_thickness[WT_LAYER_STEPS];
    double deviate[WT_LAYER_STEPS]; /* how far off such a layer is, as a standard normal one */
} wt_layer_profile;
/* Bulk, then track; log_ratio: ln of the modulus of the track over that of the bulk with its error,
 * whose degrees of freedom are ratio_df, infinite: it is normal. Fewer than 12 curves of one of
 * them, or a ratio that is not known, tell nothing. */
WT_API wt_status wt_layer_profile_make(const wt_contact_table *const table[2], double poisson_ratio,
                                       const wt_depth_curve *const curve[2], const size_t n[2],
                                       wt_estimate log_ratio, double ratio_df,
                                       wt_layer_profile *profile, wt_error *err) WT_NODISCARD;
/* The modulus of a homogeneous rubber with the force of a layer that has the ratio of the track
 * where the contact radius is that of the profile, over the modulus of the bulk, at another contact
 * radius [m]; NaN where the law does not reach. */
WT_API double wt_layer_modulus(const wt_layer_profile *profile, double ratio, double thickness,
                               double contact_radius);

/* Thicknesses that differ by less than this factor agree: the balance of a layer goes with
 * constants that are known to no better than their order. */
#define WT_LAYER_MARGIN 2.0
typedef struct wt_layer_agreement {
    /* Interval of 95 % of the thickness that both allow [m]; 0, infinity: no end; NaN: none. */
    double low, high;
    double ratio_low, ratio_high; /* of that by the curves over the other; 0, infinity: no end */
    bool differ, agree;           /* p < 0.01; the whole ratio is within the margin */
} wt_layer_agreement;
/* other: a thickness that is known in another way, its interval of 95 %. */
WT_API wt_layer_agreement wt_layer_compare(const wt_layer_profile *profile, wt_interval other);

/* ---- groups and their comparison ------------------------------------------------------------- */

/* One group of moduli: accepted curves only; spot[i] numbers the place on the sample (curves on one
 * spot are not independent), NULL = each curve is its own spot and the result says so. */
typedef struct wt_group {
    const double *modulus;  /* [n] Pa, > 0 */
    const long *spot;       /* [n] or NULL */
    const double *rate;     /* [n] of the indentation [m/s]; NULL = all curves count as one rate */
    const long *rate_class; /* [n], with `rate`: what of both groups is the same nominal rate */
    size_t n;
    size_t n_rejected;
    double spot_scatter; /* standard deviation of ln E from spot to spot as known otherwise, where
                            one spot does not tell it; 0 = not known */
} wt_group;

typedef struct wt_group_summary {
    size_t n, n_rejected, n_spots;
    double mean, standard_deviation; /* of the curves [Pa] */
    double geometric_mean;           /* of the units (spots, or curves) [Pa] */
    double log_standard_error;       /* standard error of its logarithm */
    double df;                       /* of that error, as Student's t has them */
    double low, high;                /* 95 % interval of the geometric mean [Pa] */
    double median;                   /* of the curves [Pa] */
} wt_group_summary;

/* How the rates of the two groups were made comparable. */
typedef enum wt_rate_matching {
    WT_RATES_COMMON,  /* the rates that both groups have, or no rates */
    WT_RATES_WITHIN,  /* a slope of ln E against ln rate within the spots */
    WT_RATES_BETWEEN, /* such a slope between the spots, for each has one rate */
} wt_rate_matching;

/* Why there is no interval. */
typedef enum wt_verdict_undecided_reason {
    WT_SETTLED,
    WT_ONE_SPOT,    /* in a group, and fewer than three in the other: how spots scatter is not
                       known */
    WT_RATES_APART, /* no rate in common and no slope */
    WT_RATES_TWIST  /* no rate in common, and the slopes of the groups differ */
} wt_verdict_undecided_reason;

typedef struct wt_comparison {
    wt_group_summary bulk, track;     /* of all curves */
    bool by_spot;                     /* the unit of analysis is the spot */
    size_t n_bulk, n_track;           /* units that were compared */
    size_t curves_bulk, curves_track; /* of these rates */
    wt_rate_matching rates_by;
    wt_verdict_undecided_reason unsettled;
    bool scatter_given;                  /* the interval is that of the groups' spot_scatter */
    wt_estimate log_ratio;               /* ln(E_track / E_bulk) */
    double df;                           /* degrees of freedom of its standard error */
    double ratio, ratio_low, ratio_high; /* with 95 % interval; NaN if unsettled */
    double t, p;                         /* two-sided, of ln(E_track / E_bulk) */
    double effect_size;                  /* Hedges g of ln E, track minus bulk */
    double scatter;                      /* standard deviation of ln E between the units */
    double known_share;                  /* of the variance that is that of `offset` */
    double mann_whitney_u;               /* pairs in which the track is stiffer; ties count half */
    double mann_whitney_p;               /* two-sided */
    double mann_whitney_smallest_p;      /* that these numbers of units allow */
    bool mann_whitney_exact; /* small and without ties; else normal, corrected for ties */
    wt_estimate rate_slope;  /* d ln E / d ln rate within the spots; NaN if not known */
    double interaction_p;    /* of the slopes of the two groups being one; NaN if not known */
} wt_comparison;

/* What curves show beside the modulus, by group. */
typedef struct wt_sign_comparison {
    double mean[2];          /* of the spots; NaN: none known */
    double larger_chance[2]; /* of as much larger in this group than in the other by scatter alone
                                (Welch, one-sided); NaN with fewer than two spots in a group */
} wt_sign_comparison;
/* values: [n] of each curve, those that are not finite are left out; spots: [n], NULL: each curve
 * is a unit. */
WT_API wt_status wt_compare_signs(const double *const values[2], const long *const spots[2],
                                  const size_t n[2], wt_sign_comparison *signs,
                                  wt_error *err) WT_NODISCARD;
/* The chance of two independent tests together (Fisher 1932); of one that is NaN, of the other. */
WT_API double wt_combined_p_value(double a, double b);
/* A curve down to a depth [m], where the lever is bent by `bending` [m], by a pyramid or cone whose
 * cap has another radius [m] than the stated one, fitted by the law of the stated one: ln of the
 * modulus over the true one, and the root mean square of what is left, of the largest force. */
typedef struct wt_tip_wear {
    double log_modulus, misfit;
} wt_tip_wear;
WT_API wt_status wt_tip_wear_fit(const wt_tip *stated, double radius, double depth, double bending,
                                 wt_tip_wear *fit, wt_error *err) WT_NODISCARD;
/* WT_E_EMPTY for n = 0, WT_E_RANGE for a modulus that is not positive. With one unit its interval
 * is NaN. */
WT_API wt_status wt_group_summarise(const wt_group *group, wt_group_summary *summary,
                                    wt_error *err) WT_NODISCARD;
/* Welch, Biometrika 34 (1947) 28, with the freedom of Satterthwaite, Biometrics Bull. 2 (1946) 110;
 * Mann and Whitney, Ann. Math. Stat. 18 (1947) 50; Hedges, J. Educ. Stat. 6 (1981) 107.
 * The units are spots if both groups name them, else curves. `offset` is what ln(E_track / E_bulk)
 * is known to hold beside the difference, such as a temperature or separate levers, with its
 * standard error; NULL = nothing. WT_E_EMPTY for a group without curves, WT_E_RANGE for a modulus
 * that is not positive or groups without any scatter. */
WT_API wt_status wt_compare(const wt_group *bulk, const wt_group *track, const wt_estimate *offset,
                            wt_comparison *result, wt_error *err) WT_NODISCARD;
/* The smallest number of spots in each group at which a difference `log_ratio` of ln E is seen in
 * four of five trials when spots scatter by `scatter`; 0 if 1000 are not enough. */
WT_API size_t wt_spots_needed(double log_ratio, double scatter);
/* What is known of the logarithm of a ratio. */
typedef struct wt_log_ratio {
    double value, standard_error;
    double df; /* of its error; NaN: a normal one */
} wt_log_ratio;
/* a - b of two that know nothing of each other: Welch, with the freedom of Satterthwaite, as above.
 * What cannot be said is NaN. */
typedef struct wt_log_ratio_difference {
    double value, low, high; /* with its interval of 95 % */
    double df;               /* NaN: a normal error */
    double p;                /* two-sided, that there is none */
} wt_log_ratio_difference;
WT_API wt_log_ratio_difference wt_log_ratio_compare(const wt_log_ratio *a, const wt_log_ratio *b);
/* Holm's correction (Scand. J. Stat. 6 (1979) 65) of n p-values for n rates; adjusted[n]. A NaN
 * stays and is not counted. */
WT_API void wt_holm(const double *p, size_t n, double *adjusted);
/* Equivalent angular frequency [rad/s] of a loading of time t [s] with F ~ delta^p: exp(psi(p+1))/t
 * (2.52/t for p = 2, 2.02/t for p = 1.5). NaN for t <= 0. */
WT_API double wt_equivalent_frequency(double load_time, double force_exponent);

/* ---- peaks and values of a curve against temperature --------------------------------------- */

/* The maximum of a curve of scattered points. The errors are those of the scatter of the points,
 * not of the thermometer. */
typedef struct wt_peak {
    bool found;
    wt_interval at, height; /* NaN if not found; ends that few points do not bound are NaN, too */
    size_t n;               /* points used */
    double misfit;          /* root mean square of what they are off the curve, of the height */
    const char *why_not;    /* "", or why it is not found or not bounded; static */
} wt_peak;
/* x rising, y > 0. The curve is a parabola of ln y with a smooth departure from it, as smooth as
 * the points say, down to half the height; with `points` > 0 a plain parabola of y through so many
 * points about the largest. A largest point that is one of the outer two on a side is no peak. */
WT_API wt_status wt_peak_find(const double *x, const double *y, size_t n, size_t points,
                              wt_peak *peak, wt_error *err) WT_NODISCARD;
/* Other maxima beside the largest point, rising in x: each in the range between the valleys that
 * part it, from which the values rise by a tenth at least, and found there like that of
 * wt_peak_find. At most `most` of them; *n: how many. */
WT_API wt_status wt_secondary_peaks(const double *x, const double *y, size_t n, size_t most,
                                    wt_peak *peaks, size_t *n_peaks, wt_error *err) WT_NODISCARD;
/* Where the storage modulus begins to fall, the extrapolated onset of ASTM E1640:
 * the tangent of ln y where it falls most steeply meets the tangent of the glass, which is laid
 * where, colder, it falls with a tenth of that slope. */
typedef struct wt_onset {
    bool found;
    wt_interval at;      /* NaN if not found */
    size_t n;            /* points used */
    const char *why_not; /* "", or why it is not found; static */
} wt_onset;
/* x rising, y > 0; the curve is that of wt_peak_find through the points about the fall. */
WT_API wt_status wt_onset_find(const double *x, const double *y, size_t n, wt_onset *onset,
                               wt_error *err) WT_NODISCARD;
/* The value at a place by such a curve through its neighbours; NaN outside of the points. */
WT_API wt_status wt_value_between(const double *x, const double *y, size_t n, double at,
                                  wt_interval *value, wt_error *err) WT_NODISCARD;

/* ---- strain sweeps (Payne effect) ------------------------------------------------------------ */

/* Kraus 1984, as in Rutherford et al., Polymers 15 (2023) 1675 (doi:10.3390/polym15071675): storage
 * = storage_inf + (storage_0 - storage_inf) / (1 + x^2), loss = loss_inf + (loss_m - loss_inf) 2 x
 * / (1 + x^2), x = (strain / strain_c)^exponent. */
typedef struct wt_kraus {
    double storage_0, storage_inf, strain_c, exponent, loss_m, loss_inf;
} wt_kraus;
WT_API double wt_kraus_storage(const wt_kraus *law, double strain);
WT_API double wt_kraus_loss(const wt_kraus *law, double strain);

/* What is not reached in the range measured is NaN. */
typedef struct wt_payne {
    /* As measured: means of up to three points of the smallest amplitudes (those within a factor of
     * three of the smallest) and of the three largest; amplitudes at which the storage modulus
     * first falls below 0.9 and 0.5 of its start, between points linear in ln strain; the largest
     * loss modulus, and its amplitude unless that is one of the outer two on a side. */
    double storage_start, loss_start, storage_end;
    double strain_tenth, strain_half, loss_max, strain_loss_max;
    /* Least squares with equal errors of the storage moduli; the loss moduli then follow its
     * strain_c and exponent. Intervals are those of the profiled sum of squares, ends that the
     * points do not bound are NaN. strain_c is where half of the fall is reached. */
    bool fitted;
    wt_kraus law;
    wt_interval storage_0, storage_inf, strain_c, exponent, loss_m, loss_inf;
    double storage_misfit, loss_misfit; /* root mean square of what the points are off, of
                                           storage_0 and of loss_max */
    const char *note;                   /* "", or why there is no fit or what it lacks; static */
    const char *loss_note;              /* likewise of the loss modulus */
} wt_payne;
/* strain rising and, like the moduli, > 0; loss NULL: not measured, and what is told of it NaN. */
WT_API wt_status wt_payne_fit(const double *strain, const double *storage, const double *loss,
                              size_t n, wt_payne *payne, wt_error *err) WT_NODISCARD;

/* ---- dwells ---------------------------------------------------------------------------------- */

/* An approach, the dwell behind it and the retract behind that, in the order of time. */
typedef struct wt_dwell_history {
    const double *time;     /* [n] [s], rising; n = n_approach + n_dwell + n_retract */
    const double *position; /* [n] height [m], turned so that it rises into the sample */
    const double *force;    /* [n] [N], as measured */
    size_t n_approach, n_dwell, n_retract; /* the last may be 0; it tells the drift of the force */
    double spring_constant;                /* [N/m] */
    double poisson_ratio;
    double contact_point, modulus; /* of a fit of the approach, to begin with; [m], [Pa] */
    double baseline_offset;        /* likewise [N] */
    wt_estimate baseline_tilt;     /* likewise [N/m] */
} wt_dwell_history;

/* A mean of the dwell. */
typedef struct wt_dwell_point {
    double time, force, indentation; /* from contact [s], above the baseline [N], [m] */
    double modulus, fitted; /* of an elastic sample with this force at this indentation [Pa], and
                               what the fit makes of it */
} wt_dwell_point;
/* The errors hold noise, contact point, baseline, drift and what the times measured leave open of
 * the spectrum; not lever, tip and sensitivity. The part that curves of one kind share, by what is
 * assumed of drift and spectrum, is also told by itself. */
typedef struct wt_dwell_moduli {
    double angular_frequency;  /* [rad/s] */
    wt_estimate storage, loss; /* [Pa] */
    double storage_common_error, loss_common_error;
} wt_dwell_moduli;
enum { WT_DWELL_POINTS = 32, WT_DWELL_FREQUENCIES = 32 };
typedef struct wt_dwell {
    bool found, creep;          /* creep: the force was held, else the height */
    const char *why_not;        /* "", or why there are no moduli; static */
    double load_time, duration; /* contact to dwell, and the dwell [s] */
    double contact_point, baseline_offset, baseline_tilt; /* as in a history */
    double drift, drift_from;        /* of the force [N/s], since that time [s] */
    double indentation_common_error; /* of the indentation at the end [m], what curves of one kind
                                        share; NaN as below */
    double misfit, misfit_p; /* sum of squares over its degrees of freedom, by which the errors
                                     are wider where it is above 1; chance of more by noise: below
                                     0.01 the errors are not known (NaN) */
    size_t n, n_points;
    wt_dwell_moduli moduli[WT_DWELL_FREQUENCIES]; /* four a decade, 10^(i/4) rad/s, between one over
                                                     the times from contact that the dwell has */
    wt_dwell_point point[WT_DWELL_POINTS];
} wt_dwell;
/* Relaxation modulus through approach and dwell, with contact point, baseline and drift, by the
 * hereditary integral of Lee and Radok over the heights as measured (the indentation must not
 * fall), and the storage and loss modulus of it. */
WT_API wt_status wt_dwell_fit(const wt_contact_table *table, const wt_dwell_history *history,
                              wt_dwell *dwell, wt_error *err) WT_NODISCARD;

/* A sine in height and force: complex amplitudes A (real and imaginary part) of A exp(i omega (t -
 * start)). */
typedef struct wt_modulation {
    bool found;
    const char *why_not;       /* "", or why there is none; static */
    double angular_frequency;  /* [rad/s] */
    double start;              /* [s] */
    double amplitude[4];       /* of height [m] and force [N] */
    double mean_time, mean[2]; /* [s], height [m] and force [N], with the weights of the sine */
} wt_modulation;
/* Least squares with weights of Hann beside a cubic and a logarithm of the time. angular_frequency:
 * of the drive, or NaN: the strongest of the height. A height that moves no more than its noise is
 * no modulation. */
WT_API wt_status wt_modulation_fit(const double *time, const double *position, const double *force,
                                   size_t n, double angular_frequency, wt_modulation *modulation,
                                   wt_error *err) WT_NODISCARD;
/* Takes it out of the samples that it was found in. */
WT_API void wt_modulation_remove(const wt_modulation *modulation, const double *time, size_t n,
                                 double *position, double *force);
/* E* = k* / slope with the dynamic stiffness k* of the contact; slope = dF/ddelta of the tip over
 * the modulus at the mean depth [m]. air: the same drive free of the sample, whose drag and
 * crosstalk are taken off; NULL: none. The errors are NaN: those of noise and depth held the truth
 * in 88 % of simulated curves only; several modulations tell them by their scatter. */
WT_API wt_status wt_modulation_moduli(const wt_modulation *modulation, const wt_modulation *air,
                                      double spring_constant, double slope, wt_dwell_moduli *moduli,
                                      wt_error *err) WT_NODISCARD;

/* ---- deflection sensitivity: curves on a hard surface ---------------------------------------- */

/* The part of the contact by which the slope is measured: shares of the rise of the signal. */
typedef struct wt_slope_options {
    double from, to;
} wt_slope_options;
WT_API wt_slope_options wt_slope_defaults(void);
WT_API const wt_params *wt_slope_params(void);

/* One way of a curve. Errors are those of the scatter within it, with `freedom` degrees: lines
 * through the means of as many blocks of samples, so that noise which lasts shorter than a block is
 * in them. */
typedef struct wt_contact_slope {
    bool found;
    char why_not[96];              /* "", or why there is no slope */
    double slope, slope_error;     /* of the signal against the piezo, with the error of the tilt:
                                      [unit of the signal / m] */
    double change, change_error;   /* of the slope from end to end of the part, of the slope */
    double tilt;                   /* of the baseline, subtracted, of the slope; NaN: none seen */
    double misfit;                 /* root mean square of the residuals, of the rise */
    double signal_from, signal_to; /* the part, above the baseline */
    double travel;                 /* of the piezo in it [m] */
    size_t n;                      /* samples in it */
    double freedom;
} wt_contact_slope;
/* Piezo position [m] of either direction and the signal, which is larger in contact, in the order
 * of time of an approach or a retract. NaN samples are left out. */
WT_API wt_status wt_contact_slope_fit(const double *position, const double *signal, size_t n,
                                      const wt_slope_options *options, wt_contact_slope *slope,
                                      wt_error *err) WT_NODISCARD;
/* Mean of n values: of the means of their units (spots, files), numbered in `units`, if there are
 * three units or more, else of the values; those of a unit stand one behind another, NULL: there
 * are no units. Interval of 95 % by Student's t with *n_units - 1 degrees of freedom; of one value
 * the error and the ends are NaN. */
WT_API wt_interval wt_student_mean(const double *values, const long *units, size_t n,
                                   size_t *n_units);

/* ---- friction records ------------------------------------------------------------------------ */

/* What friction is averaged over before anything is said of its scatter: a wave of the lap or of
 * the stroke is no scatter. */
typedef enum wt_cycle_kind {
    WT_CYCLE_AUTO,   /* strokes, laps or spans of time, the first that the record tells */
    WT_CYCLE_STROKE, /* there and back */
    WT_CYCLE_LAP,    /* whole revolutions */
    WT_CYCLE_TIME,   /* equal spans of time */
    WT_CYCLE_SAMPLE  /* none: every sample by itself */
} wt_cycle_kind;

/* Means over one cycle; what was not recorded is NaN. */
typedef struct wt_cycle {
    size_t first, n, step;
    double time, distance, laps; /* at its middle */
    double coefficient;
    double zero;      /* of strokes: mean of there and back, with their signs, as a coefficient */
    double deviation; /* of its samples */
    double normal_force, velocity, pressure, temperature, wear_depth;
    double rotation; /* of the disc [rad/s] */
    double duration; /* to the first sample of the next one [s] */
} wt_cycle;

typedef struct wt_cycles {
    wt_cycle_kind kind;
    size_t n;
    wt_cycle *cycle;
    double *friction; /* [samples of the record] coefficient with its sign */
    double samples;   /* in a cycle, the median */
    double
        difference; /* largest of mu and friction force over load, where the file has both; NaN */
    bool has_zero;  /* there and back have opposite signs */
    size_t n_unloaded; /* samples that a load of 0 or less gives no coefficient */
} wt_cycles;
/* `radius` [m] of the track tells laps by the distance, and the velocity by the rotation; NaN: not
 * known. `load` [N] where none was recorded; NaN. `kind` other than WT_CYCLE_AUTO that the record
 * does not tell is WT_E_MISSING. */
WT_API wt_status wt_cycles_make(const wt_record *record, wt_cycle_kind kind, double radius,
                                double load, wt_cycles *cycles, wt_error *err) WT_NODISCARD;
WT_API void wt_cycles_clear(wt_cycles *cycles);

/* Where a series becomes steady: a line with scatter of its own, then a constant with another. Both
 * scatters are white beside an autoregression of first order, over whose length and share the
 * likelihood is averaged, as over the place. */
typedef struct wt_running_in {
    bool seen;           /* odds above 20 to 1 over a series without one */
    wt_interval end;     /* points before the steady part: median and interval of 95 %; NaN */
    size_t steady_from;  /* first point of the steady part: behind the interval; 0: all is */
    const char *why_not; /* "", or why there is no end; static */
} wt_running_in;
WT_API wt_status wt_running_in_find(const double *y, size_t n, wt_running_in *running_in,
                                    wt_error *err) WT_NODISCARD;
/* By the rules that others use, as first point of the steady part: one change of the mean by least
 * squares, at least 2 % from either end; MSER-5 of White, Simulation 69 (1997) 323. */
WT_API size_t wt_step_detect(const double *y, size_t n);
WT_API size_t wt_mser_5(const double *y, size_t n);

/* Mean and drift of a steady series whose scatter is correlated. Intervals are of 95 %, averaged
 * over what the series does not tell of the correlation, the mean over a drift and none. */
typedef struct wt_steady {
    size_t n;
    wt_interval mean;
    wt_interval drift;          /* per point */
    double deviation, min, max; /* of the points */
    double correlation;         /* variance of the mean over that of as many independent points */
    const char *note;           /* "", or what is lacking; static */
} wt_steady;
WT_API wt_status wt_steady_mean(const double *y, size_t n, wt_steady *steady,
                                wt_error *err) WT_NODISCARD;

/* Falls of the samples that stand out of their scatter and follow slower rises. */
typedef struct wt_stick_slip {
    size_t n;              /* slips; 0: none stand out */
    double amplitude;      /* mean height of the falls; NaN */
    double standard_error; /* by their scatter */
} wt_stick_slip;
WT_API wt_status wt_stick_slip_find(const double *y, size_t n, wt_stick_slip *slips,
                                    wt_error *err) WT_NODISCARD;

/* A wear track in a profile across it: heights over a line through the outer quarters. */
typedef struct wt_track {
    bool found; /* two samples in a row lie deeper than 3 standard deviations of the outer quarters
                 */
    double slope, intercept, scatter; /* of the line, and about it */
    double depth, at, from, to;       /* deepest point; where the track begins and ends */
    wt_estimate area;                 /* below the line between them; error by the line's scatter */
    double ridges;                    /* area above the line between them */
} wt_track;
/* Positions x rising, heights z, both [m]. WT_E_RANGE of fewer than 40 points. */
WT_API wt_status wt_track_find(const double *x, const double *z, size_t n, wt_track *track,
                               wt_error *err) WT_NODISCARD;

/* ---- thermal noise of a lever ---------------------------------------------------------------- */

/* Thermal tune: a simple harmonic oscillator (of a lever: Butt and Jaschke, Nanotechnology 6 (1995)
 * 1) on a white floor: S(f) = floor + 2 mean_square f0^3 / (pi Q) /
 * ((f0^2 - f^2)^2 + (f f0 / Q)^2), one-sided. Intervals are of 95 %, normal in the logarithm. */
typedef struct wt_thermal {
    bool found;
    wt_interval mean_square; /* of the oscillator over all frequencies [density Hz] */
    wt_interval resonance;   /* f0 [Hz] */
    wt_interval quality;     /* Q */
    double floor;            /* [density] */
    double from, to;         /* range that was fitted [Hz] */
    size_t n;                /* points in it */
    double averages;         /* spectra averaged, as the scatter about the fit tells */
    double chance;           /* of as much slow departure from the oscillator by scatter alone */
    const char *why_not;     /* "", or why there is none; static */
} wt_thermal;
/* Maximum likelihood of an averaged periodogram: frequencies [Hz] rising, densities [unit^2/Hz];
 * points without a positive density are left out. from and to [Hz]: NaN = about the peak. */
WT_API wt_status wt_thermal_fit(const double *frequency, const double *density, size_t n,
                                double from, double to, wt_thermal *thermal,
                                wt_error *err) WT_NODISCARD;

/* ---- Sader's method -------------------------------------------------------------------------- */

typedef enum wt_medium { WT_MEDIUM_AIR, WT_MEDIUM_WATER } wt_medium;
typedef struct wt_fluid {
    double density, viscosity; /* [kg/m^3], [Pa s] */
} wt_fluid;
/* Dry air at 1013.25 hPa (Sutherland's law) or water (density: Tanaka et al., Metrologia 38 (2001)
 * 301; viscosity: IAPWS) at a temperature [K]; NaN for water that is not liquid. */
WT_API wt_fluid wt_medium_properties(wt_medium medium, double temperature);
/* Of a rectangular blade at the Reynolds number density omega width^2 / (4 viscosity), above 0
 * (Sader, J. Appl. Phys. 84 (1998) 64). */
WT_API void wt_hydrodynamic_function(double reynolds, double *real, double *imaginary);
/* k = 0.1906 density width^2 length Q Im Gamma omega^2 of a rectangular lever much longer than wide
 * (Sader, Chon and Mulvaney, Rev. Sci. Instrum. 70 (1999) 3967) from SI values above 0, its error
 * by theirs. */
WT_API wt_estimate wt_sader_spring_constant(wt_estimate length, wt_estimate width,
                                            wt_estimate resonance, wt_estimate quality,
                                            wt_fluid fluid);

/* ---- surfaces: heights, power spectra, their self-affine law ----------------------------------
 */

typedef enum wt_surface_window {
    WT_WINDOW_HANN,
    WT_WINDOW_WELCH,
    WT_WINDOW_NONE
} wt_surface_window;

typedef enum wt_surface_form { WT_FORM_MEAN, WT_FORM_PLANE, WT_FORM_QUADRATIC } wt_surface_form;

typedef struct wt_surface_options {
    wt_surface_form form; /* polynomial of two variables that is taken off by least squares */
    wt_surface_window window;
    double largest_missing; /* share of the heights; more of them are refused */
    double points_per_wave; /* fewest that are trusted: 2 is the Nyquist wavenumber */
    double tip_radius;      /* [m]; NaN: not known */
} wt_surface_options;
WT_API wt_surface_options wt_surface_options_defaults(void);

/* What the heights are, less their form: ISO 25178-2 (of a profile ISO 21920-2, where the same
 * numbers are called R), over the points that there are. Slopes are by forward differences of
 * neighbours; Sdr by the two at a point. Other stencils give other slopes. */
typedef struct wt_surface_heights {
    size_t n, missing;
    double rms, mean_deviation, peak_to_valley; /* Sq, Sa, Sz [m] */
    double skewness, kurtosis;                  /* Ssk, Sku */
    double rms_slope, slope_x, slope_y;         /* Sdq, and its parts; of a profile that along x */
    double area_excess;                         /* Sdr; NaN of a profile */
} wt_surface_heights;

enum { WT_SURFACE_SECTORS = 18 }; /* of a half turn */
/* Modes with wavenumbers between 10^((index - 1/2)/10) and 10^((index + 1/2)/10) rad/m. */
typedef struct wt_spectrum_bin {
    int index;
    double wavenumber, mean_wavenumber; /* geometric and arithmetic mean [rad/m] */
    double width;                       /* standard deviation of ln q of its modes */
    double density;                     /* mean: C [m^4] or C1 [m^3], two-sided */
    double deviation;                   /* standard deviation of a mode of a scan */
    size_t n;                           /* modes, of the full plane or of both signs */
    size_t scans;                       /* that they are of */
    double freedom; /* degrees of freedom of the mean, as of chi-squared: fewer than n, for a window
                       ties neighbours together */
    double shared_freedom; /* its part of those of all bins together: modes of two bins are tied,
                              too */
    double cosine, sine;   /* C(phi) = C (1 + cosine cos 2 phi + sine sin 2 phi + */
    double cosine_fourth, sine_fourth; /* the same of 4 phi), phi from x */
    /* Modes within half a sector of k pi / WT_SURFACE_SECTORS, and the sum of C of each over the
     * mean of all; none of profiles. */
    double sector_modes[WT_SURFACE_SECTORS], sector_sum[WT_SURFACE_SECTORS];
    double sector_tie; /* how many modes of a sector are as one that is independent */
    bool reliable;
} wt_spectrum_bin;

/* With h_rms^2 = 2 pi int q C dq and = 2 int_0^inf C1 dq; q = 2 pi / wavelength. */
typedef struct wt_surface_spectrum {
    wt_spectrum_kind kind;
    size_t n;
    wt_spectrum_bin *bins;
    double from, to;     /* the reliable range [rad/m] */
    const char *ends_by; /* "points" or "tip"; static */
    /* Of several scans: standard deviation of ln C from place to place, the same at all
     * wavenumbers; the one of which an interval has 1.96, which holds what few places and the
     * scatter of the modes leave open of it; and the standard error that this gives the mean: of
     * each bin by its scans, and the mean of these squared over the bins; NaN: not known. */
    double place_scatter, place_reach, place_error;
    /* Scans that have the same part in every bin, as those of one size have, are off in all bins
     * together, and not with others: how many such sizes there are (0: not kept), the widest
     * first, and [n_sizes] for each bin the standard error of ln C by one, over place_reach. */
    size_t n_sizes;
    double *place_part;
} wt_surface_spectrum;
WT_API void wt_surface_spectrum_clear(wt_surface_spectrum *spectrum);

/* Heights less their form, missing ones filled as a membrane, window, discrete Fourier transform,
 * means over bins (conventions: Jacobs, Junge, Pastewka, Surf. Topogr. 5 (2017) 013001, but with
 * C = C2D / (2 pi)^2 and C1 = C1D / (2 pi) of theirs). A map of one row gives C1. The range ends at
 * points_per_wave, or where the curvature of peaks reaches half that of the tip (Sanner et al.,
 * Appl. Surf. Sci. Adv. 7 (2022) 100190). WT_E_RANGE: too many heights are missing; WT_E_EMPTY:
 * too few points, or all heights the same. */
WT_API wt_status wt_surface_analyse(const wt_height_map *map, const wt_surface_options *options,
                                    wt_surface_heights *heights, wt_surface_spectrum *spectrum,
                                    wt_error *err) WT_NODISCARD;
/* One of several of one kind: means of ln C over the reliable bins, weighted by their modes and
 * without what a mean of logarithms is too low by. WT_E_EMPTY: no bin is reliable. */
WT_API wt_status wt_surface_join(const wt_surface_spectrum *const *spectra, size_t n,
                                 wt_surface_spectrum *joined, wt_error *err) WT_NODISCARD;
/* C of C1 of a surface that is the same in all directions; the slope at the end goes on. Bins that
 * the scatter makes negative are left out. WT_E_RANGE: the end is too flat for that, or
 * the profiles are too few: bins that are not known to a factor of two are left out. */
WT_API wt_status wt_surface_invert(const wt_surface_spectrum *profile, wt_surface_spectrum *surface,
                                   wt_error *err) WT_NODISCARD;
/* C [n] at the wavenumbers of C1, without errors. WT_E_RANGE where it is not above 0, too. */
WT_API wt_status wt_surface_of_profile(const double *wavenumber, const double *c1, size_t n,
                                       double *c, wt_error *err) WT_NODISCARD;
/* What lies behind a bin of a spectrum, with the scatter from place to place as far as it is known.
 * Its standard error, and those of c0 and roll_off below, are of the logarithm, times the value. */
WT_API wt_interval wt_surface_density(const wt_surface_spectrum *spectrum, size_t bin);

/* Whether the directions differ: C(phi) = C (1 + amplitude cos order (phi - direction)), the mean
 * over the modes of all reliable bins. Standard errors are by the scatter of the modes. */
typedef struct wt_surface_anisotropy {
    double amplitude, direction; /* [rad] from x, -pi/order to pi/order: of a maximum */
    double amplitude_error, direction_error;
    double chance; /* of as much by scatter alone */
} wt_surface_anisotropy;
/* order: 2 or 4. NaN of profiles. */
WT_API wt_surface_anisotropy wt_surface_directions(const wt_surface_spectrum *spectrum,
                                                   unsigned order);
/* C within half a sector of sector pi / WT_SURFACE_SECTORS from x over that of all directions, the
 * mean over the modes of all reliable bins; of how many modes. NaN without any. */
WT_API wt_interval wt_surface_sector(const wt_surface_spectrum *spectrum, size_t sector,
                                     double *modes);

/* C = c0 up to roll_off, c0 (q / roll_off)^(-2 (1 + hurst)) above it. */
typedef struct wt_self_affine {
    bool found;
    bool rolls_off; /* else roll_off is the first wavenumber, without an error */
    wt_interval c0, roll_off, hurst;
    double covariance[3][3];       /* of ln c0, ln roll_off, hurst, with the next */
    double place_covariance[3][3]; /* what places make of it */
    double misfit; /* chi-squared over its degrees of freedom; above 1 the errors hold it */
    size_t n;      /* bins */
} wt_self_affine;
/* Weighted least squares in ln C over the reliable bins. WT_E_MEMORY. */
WT_API wt_status wt_self_affine_fit(const wt_surface_spectrum *spectrum, wt_self_affine *law,
                                    wt_error *err) WT_NODISCARD;
/* C of the law at a wavenumber, NaN if it was not found; and the standard error of its logarithm by
 * the covariance: half an interval of 95 % over 1.96, with what places add or without. */
WT_API double wt_self_affine_density(const wt_self_affine *law, double wavenumber);
WT_API double wt_self_affine_log_error(const wt_self_affine *law, double wavenumber, bool places);

/* The wavenumber at which the rms slope of the roughness from its q0 on reaches `slope`; NaN if it
 * does not. */
WT_API double wt_roughness_slope_end(const wt_roughness *roughness, double slope);

/* ---- master curve: one spectrum behind all isotherms ----------------------------------------- */

typedef enum wt_vertical_shift {
    WT_VERTICAL_NONE,
    WT_VERTICAL_PHYSICAL, /* b = rho0 T0 / (rho T) */
    WT_VERTICAL_FREE,
    WT_VERTICAL_TIED /* physical within the scatter of clamping and what departs smoothly with
                        temperature; how far is averaged over */
} wt_vertical_shift;

/* What the spectrum is fitted to and the isotherms are shifted by. */
typedef enum wt_shift_by {
    WT_BY_MODULI,     /* both, or what was measured of all isotherms */
    WT_BY_STORAGE,    /* E' or G' alone */
    WT_BY_LOSS,       /* E'' or G'' alone: the equilibrium modulus, and so E', stay unknown */
    WT_BY_LOSS_FACTOR /* tan delta alone: no level of the moduli, no vertical shift */
} wt_shift_by;

typedef enum wt_reference_at {
    WT_REFERENCE_TEMPERATURE,   /* as reference_temperature says */
    WT_REFERENCE_TAN_DELTA_PEAK /* where tan delta peaks at 1 Hz; WT_E_RANGE if it does not */
} wt_reference_at;

typedef struct wt_master_options {
    double reference_temperature; /* [K]; need not be a measured isotherm; NaN (default): the
                                     isotherm in the middle */
    wt_vertical_shift vertical;   /* default TIED */
    double expansion;             /* volumetric thermal expansion of rho T [1/K], default 0 */
    double terms_per_decade; /* of the spectrum; NaN (default): 3, or 10 if it is sharp lines */
    bool liquid;             /* equilibrium modulus 0 */
    bool series_only;        /* no moduli of the spectrum at the points (NaN) and no verdict */
    wt_shift_by shift_by;    /* default MODULI */
    wt_reference_at reference_at;
} wt_master_options;
WT_API wt_master_options wt_master_options_defaults(void);
WT_API const wt_params *wt_master_options_params(void);

/* One isotherm: x_r = log10 w + log_a, y_r = log10 M + log_b, b multiplies what was measured. */
typedef struct wt_master_shift {
    double temperature;       /* [K] */
    bool determined;          /* false: log_a and log_b are NaN and it is not in the curve */
    wt_interval log_a, log_b; /* as measured, decades; log_a 0 at the reference isotherm */
    double log_b_physical;    /* what rho T would give */
    double log_b_material;    /* at this temperature without the scatter of clamping */
    wt_interval law;          /* log10 aT of the law at this temperature; NaN without one */
    double overlap;           /* frequencies shared with another one [decade] */
    double noise_factor;      /* of this isotherm against the others */
    size_t n_outliers;        /* values left out */
    char note[128];           /* "" or what is odd */
} wt_master_shift;

/* Where the shifts are from. */
typedef enum wt_shift_route {
    WT_SHIFTS_OF_SPECTRUM, /* fitted with one spectrum of all isotherms */
    WT_SHIFTS_OF_OVERLAP /* from neighbour to neighbour, by the overlap of the storage moduli alone:
                            one spectrum is far off the isotherms, or was not found. Of it the
                            shifts are given; the error of a shift holds what the places of an
                            overlap disagree by */
} wt_shift_route;

typedef enum wt_superposition {
    WT_SUPERPOSITION_HOLDS,
    WT_SUPERPOSITION_FAILS,
    WT_SUPERPOSITION_CANNOT_SAY
} wt_superposition;

typedef struct wt_posterior wt_posterior;

/* One relaxation spectrum, shifts and law that describe all isotherms, with the errors of
 * everything together. */
typedef struct wt_master {
    wt_deformation deformation;
    wt_loading loading;
    double reference_temperature; /* [K] */
    wt_vertical_shift vertical;
    wt_shift_route shift_route;
    double terms_per_decade; /* of the spectrum */
    size_t n_shifts;
    wt_master_shift *shifts; /* [n_shifts], rising temperature */

    size_t n;              /* measured points of the determined isotherms, by reduced frequency */
    double *log_frequency; /* [n] log10 of the reduced angular frequency [rad/s] */
    double *log_storage, *log_loss; /* [n] log10 of E' or G' [Pa], vertical shift applied */
    wt_interval *fitted_storage, *fitted_loss; /* [n] log10 of the moduli of the spectrum there */
    wt_interval *fitted_loss_factor;           /* [n] log10 of its tan delta */
    double *log_step; /* [n] log10 of what was measured after a step, at the reduced time that is
                         one over the frequency: E(t) or, of creep, 1/J(t) [Pa]; else NaN */
    wt_interval *fitted_step;         /* [n] log10 of the same of the spectrum */
    size_t *isotherm;                 /* [n] which of `shifts` */
    bool *left_out;                   /* [n] an outlier in a modulus */
    double noise_storage, noise_loss; /* relative standard deviation */
    double correlation;               /* of the noise of neighbouring points */
    size_t n_outliers;

    wt_shift_law law;                      /* kind NONE: no law, `no_law` says why */
    wt_interval offset;                    /* of the reference isotherm from the law [decade] */
    wt_interval c1, c2, activation_energy; /* NaN: the law has none */
    double c_correlation;                  /* of c1 and c2 */
    wt_interval slope;                     /* d log10 aT/dT at the reference [decade/K] */
    wt_interval pole;                      /* [K] */
    double temperature_spread; /* standard deviation of the temperature of an isotherm [K] */
    double law_rms;            /* of the shifts about the law [decade] */
    char no_law[256];

    wt_prony prony;          /* the spectrum at the reference temperature */
    wt_interval equilibrium; /* [Pa] */
    bool equilibrium_limit;  /* only `high` is known, a one-sided limit of 95 % */

    wt_superposition superposition;
    double lack_of_fit_p, misfit_low, misfit_high;           /* misfit: relative, 95 % */
    double kramers_kronig_p, loss_factor, loss_factor_error; /* ln of a factor on all E'' */
    double valid_from, valid_to;    /* [K] where superposition holds, if it fails beyond; or NaN */
    bool settled;                   /* false: a fit ended at its last step */
    char because[256];              /* of the verdict, and what would settle it */
    size_t evaluations;             /* of the model, at all points */
    double step_allowed, step_left; /* what a further step may change, and would at most
                                       [standard errors] */
    wt_posterior *posterior;
} wt_master;
WT_API void wt_master_clear(wt_master *master);

/* Fits one relaxation spectrum with shifts of all isotherms to ln E' and ln E'' together. Smoothing
 * and noise by restricted likelihood (Wood and Fasiolo, Biometrics 73 (2017) 1071), a factor on the
 * noise for each isotherm, correlation along it, single points far off left out. Isotherms and
 * points may come in any order; one isotherm is allowed. options NULL = defaults; log may be NULL.
 *
 * Points with a modulus <= 0 are left out with a warning in the log, and are an error (WT_E_RANGE)
 * naming the isotherm if fewer than four others remain. Isotherms that share less than 0.3 decade
 * of frequencies with the others are not clamped: undetermined, with a note, not in the master
 * curve. WT_E_NO_OVERLAP if no isotherm can be shifted, WT_E_RANGE for temperatures that are not
 * kelvin or a reference that the law does not reach within 0.2 decade. master: cleared by the
 * caller. */
WT_API wt_status wt_master_fit(const wt_sweep *sweep, const wt_master_options *options, wt_log *log,
                               wt_master *master, wt_error *err) WT_NODISCARD;
/* log10 aT of the law at a temperature; NaN without a law, and beyond the isotherms where fewer
 * than four tell it. */
WT_API wt_interval wt_master_law(const wt_master *master, double temperature);
/* One law of the shift factors for several samples. */
typedef enum wt_common {
    WT_COMMON_NONE, /* each its own */
    WT_COMMON_SAME, /* the same constants at the same reference temperature */
    WT_COMMON_MOVED /* the same constants, each sample at a reference temperature of its own */
} wt_common;

typedef struct wt_shared_law_member {
    bool used;
    char why_not[64];
    wt_interval moved; /* reference temperature of its law above that of the first one used [K] */
} wt_shared_law_member;

/* An isotherm of a sample that is used. Decades; without the offset of the sample. */
typedef struct wt_shared_law_point {
    size_t sample;
    double temperature; /* [K] */
    double log_a, log_a_error;
    wt_interval law;        /* the common one */
    wt_interval difference; /* what the sample's own law has more, from the middle of its isotherms
                               on, with limits on the safe side; NaN where no own laws are told */
} wt_shared_law_point;

typedef struct wt_shared_shift_law {
    wt_law_kind kind; /* WLF or Arrhenius */
    double reference; /* [K], of the first sample used */
    wt_interval c1, c2, activation_energy;
    double c_correlation; /* of C1 and C2 */
    double spread;        /* standard deviation of the temperature of an isotherm [K] */
    double p;             /* chance that samples of one law differ so much; NaN: not told */
    size_t n_members, n;
    wt_shared_law_member *members; /* [n_members] as the samples */
    wt_shared_law_point *points;   /* [n] */
} wt_shared_shift_law;
WT_API void wt_shared_shift_law_clear(wt_shared_shift_law *common);
/* Generalised least squares over the shifts of all samples with their covariance, an offset for
 * each, and one error of temperature for all isotherms, over which is averaged. WLF if one sample
 * has it by itself, else Arrhenius; samples of joined laws, with given shifts or without a fit
 * (NULL) are left out. `reference` NaN: that of the first one used. `common` is
 * cleared by the caller. WT_E_RANGE if there are fewer than two samples, or one law describes
 * nothing. */
WT_API wt_status wt_shared_shift_law_fit(const wt_master *const *masters, size_t n, wt_common how,
                                         double reference, wt_shared_shift_law *common,
                                         wt_error *err) WT_NODISCARD;
/* log10 aT of an isotherm by the closed form of ISO 18437-6 (Gergesova, Zupancic, Saprunov and
 * Emri, J. Rheol. 55 (2011) 1), for comparison: storage moduli alone, neighbour by neighbour,
 * without a vertical shift. NaN where neighbours share too little. */
WT_API double wt_master_closed_form(const wt_master *master, size_t isotherm);
/* What the spectrum was fitted to: MODULI only where both were measured. */
WT_API wt_shift_by wt_master_shifted_by(const wt_master *master);
/* tan delta as measured at point i of the master curve; NaN if it was not. */
WT_API double wt_master_loss_factor(const wt_master *master, size_t i);
/* log10 E', log10 E'' [Pa] at the reference temperature. Of one master by one thread at a time. */
WT_API void wt_master_moduli(const wt_master *master, double angular_frequency,
                             wt_interval *log_storage, wt_interval *log_loss);
/* log10 of the relaxation spectrum H, a modulus for each unit of ln tau [Pa], at the relaxation
 * time of a term of the series; NaN where that lies outside the measured frequencies. */
WT_API void wt_master_spectrum(const wt_master *master, size_t term, wt_interval *log_density);
/* One draw of all that is not known: series at the reference temperature, law, log10 b of the
 * material at the isotherms (log_b: [n_shifts], NaN where not determined; or NULL). The same seed
 * and index give the same, whatever ran before. */
WT_API wt_status wt_master_draw(const wt_master *master, uint64_t seed, size_t index,
                                wt_prony *prony, wt_shift_law *law, double *log_b,
                                wt_error *err) WT_NODISCARD;

/* ---- few terms in place of a spectrum ------------------------------------------------------ */

typedef struct wt_reduction {
    unsigned terms;   /* 0 (default): as few as the error needs */
    double error;     /* largest relative deviation of both moduli over the measured frequencies */
    double long_term; /* equilibrium modulus [Pa]; NaN (default): fitted */
} wt_reduction;
WT_API wt_reduction wt_reduction_defaults(void);
WT_API const wt_params *wt_reduction_params(void);
/* A series with few positive terms, times rising, close to both moduli of another one over its
 * range of frequencies, which must be known. Where no number of terms is close enough, or they are
 * given, it is as close as it can be: ask wt_prony_deviation. to: cleared by the caller. */
WT_API wt_status wt_prony_reduce(const wt_prony *from, const wt_reduction *options, wt_prony *to,
                                 wt_error *err) WT_NODISCARD;
/* Largest relative deviation of storage and loss modulus over the frequencies of `from`. */
WT_API void wt_prony_deviation(const wt_prony *from, const wt_prony *to, double deviation[2]);

/* A fractional Zener law through the points of a master curve that were not left out, by least
 * squares of the logarithms, and how both it and a series describe them: root mean squares in ln,
 * and Akaike's criterion with the correction for few points (Hurvich and Tsai, Biometrika 76 (1989)
 * 297), less being better. No errors: what the
 * law is off is not noise. */
typedef struct wt_zener_fit {
    double e0, eg, tau, alpha; /* (E0 + Eg z)/(1 + z), z = (i w tau)^alpha; moduli as measured */
    bool determined;           /* the points reach its glass modulus and its time */
    double rms_storage, rms_loss, aicc;
    double series_rms_storage, series_rms_loss, series_aicc;
} wt_zener_fit;
WT_API wt_status wt_master_zener(const wt_master *master, const wt_prony *series, wt_zener_fit *fit,
                                 wt_error *err) WT_NODISCARD;

#ifdef __cplusplus
}
#endif
#endif
