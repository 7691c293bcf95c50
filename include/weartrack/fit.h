/* weartrack - fit: from force curves to moduli and their comparison; from DMA sweeps to shift
 * factors, shift law, master curve and Prony series; friction records, calibration and surfaces.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WEARTRACK_FIT_H
#define WEARTRACK_FIT_H

#include "weartrack/model.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- one force curve: baseline, contact point, modulus --------------------------------------- */

/* Verdict on a curve: enumerator, identifier, text. Accepted and doubtful curves have a usable
 * modulus. The tests run in about this order; the first that applies is reported with its numbers:
 *   not_finite         more than 10 % of the samples are missing
 *   too_short          fewer than 32 different samples, or fewer than 8 in contact
 *   no_approach        the height is not monotonic, or the force falls along the segment
 *   saturated          the force is constant while the piezo moves, or its slope decreases at the
 *                      top (a contact force rises ever steeper; one false alarm in 1000), and the
 *                      part below has no modulus; with a modulus it is doubtful
 *   rigid              the indentation is less than 2 % of the cantilever deflection, or 1 % of
 *                      sensitivity would change the modulus by more than 50 %
 *   negative_modulus, no_contact   no contact point gives a positive modulus; the largest force is
 *                      less than 5 times the noise
 *   no_baseline        contact before the first sample, or a baseline of fewer than 10 samples
 * A standard error above largest_error times the modulus, with most of its variance from
 *   ambiguous_contact  a second, equally likely contact point
 *   adhesive           lack of fit, with a snap-in or a pull-off
 *   disturbed_baseline lack of fit, with a curved baseline (p below 1 %)
 *   poor_fit           other lack of fit; or no convergence
 *   imprecise          noise
 * A modulus that is
 *   doubtful           deeper than one radius of a sphere or than the range of the thin-sample law;
 *                      of a punch with hysteresis loss; with lack of fit (p below
 * misfit_p_threshold) that adds an error above doubtful_error; with interference on the baseline
 *                      above 10 % of the largest force, peak to peak
 * Verdicts that no fit gives: excluded, unreadable. */
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
/* Returns true if the modulus is usable: accepted or doubtful. The second function takes an
 * identifier. */
WT_API bool wt_curve_verdict_is_usable(wt_curve_verdict verdict);
WT_API bool wt_curve_verdict_id_is_usable(const char *id);

enum { WT_MISFIT_TERMS = 6 };

/* Estimators of the contact point of other programs, for comparison. */
typedef enum wt_contact_estimator {
    WT_CONTACT_THRESHOLD, /* the force deviates from the mean of the first tenth of the samples by
                             twice their largest deviation (nanite: deviation from baseline) */
    WT_CONTACT_VARIANCES, /* largest ratio of the variances of a twentieth of the samples after and
                             before (Gavara, Sci. Rep. 6 (2016) 21267); none if all before are equal
                           */
    WT_CONTACT_LINES,     /* intersection of a constant and a line (nanite: fit constant line) */
    WT_CONTACT_DIRECT_PATH,     /* farthest from the straight line between first sample and largest
                                   force (nanite: Frechet direct path) */
    WT_CONTACT_GOODNESS_OF_FIT, /* least squares of force against measured indentation, over
                                   baseline and contact (AtomicJ: goodness of fit) */
    WT_CONTACT_ESTIMATORS
} wt_contact_estimator;
WT_API const char *wt_contact_estimator_text(wt_contact_estimator estimator); /* static */

typedef struct wt_indent_options {
    double poisson_ratio; /* default 0.5 */
    /* Range of the fit: all limits apply together; forces are above the baseline; the baseline
     * before contact is always included. */
    double fit_depth;          /* largest indentation [m]; 0 = all (default) */
    double fit_force_fraction; /* largest force over that of the curve; default 1 */
    bool fit_tilt;           /* fits the tilt of the baseline, else only the offset; default true */
    bool contact_estimators; /* also computes other contact points, for comparison */
    double misfit_p_threshold; /* p value below which a residual is lack of fit, for noise as that
                            of the baseline; default 0.01; 0: no test */
    double largest_error; /* largest standard error over modulus of a usable modulus; default 0.5,
                             where the 95 % interval reaches twice the modulus */
    double fixed_contact_point; /* [m] tip position, NaN = fitted (default) */
    /* false (default): the measured force is compared with that of cantilever and sample at the
     * same height, because the noise is in the force. true: with the force at the measured
     * indentation, as in most programs, for comparison with them; biased if the contact is much
     * stiffer than the cantilever. */
    bool plain_least_squares;
    /* Relaxation spectrum of the rubber in Young's moduli at the temperature of the curve,
     * borrowed; NULL (default): unknown. With it the fit finds a factor on the spectrum by the
     * hereditary integral. The modulus is this factor times |E*| at 1/load_time. */
    const wt_prony *spectrum;
    double fit_radii;               /* largest indentation in tip radii; 0 = all */
    double fit_force;               /* largest force [N]; 0 = all */
    double fit_depth_from;          /* smallest indentation in the contact [m] */
    double fit_force_from;          /* smallest force in the contact [N] */
    double fit_force_fraction_from; /* smallest force in the contact over the largest */
    double doubtful_error; /* error by lack of fit over modulus above which a curve is doubtful;
                              default 0.05 */
    bool fit_retract;      /* also fits the retract alone, as a check; default false */
} wt_indent_options;
WT_API wt_indent_options wt_indent_defaults(void);
WT_API const wt_params *wt_indent_params(void);

/* Result of one curve. Positions are tip positions [m] = height - deflection along the approach,
 * rising into the sample, with a deflection free of the baseline (which is no bending). The contact
 * point is thus the height at which the tip touches with an undeflected cantilever. With z =
 * direction * height - contact_point and f = force - baseline_offset - baseline_tilt z the
 * indentation is z - f/k. Model: f = modulus/(1 - nu^2) G(indentation). */
typedef struct wt_indent_fit {
    wt_curve_verdict verdict;
    char reason[160]; /* verdict with its numbers; for an accepted curve remarks: snap-in excluded,
                         missing samples */
    wt_estimate modulus; /* E [Pa] of every fitted curve; the standard error includes baseline,
                            contact point, noise correlation, baseline curvature and misfit_error */
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
    double misfit[WT_MISFIT_TERMS]; /* cosines of the residual over the contact, of max_force */
    double max_force;               /* [N] above the baseline */
    double max_indentation;         /* [m] */
    double adhesion_force;          /* attractive force of the snap-in [N], 0 if not significant */
    wt_estimate work_of_adhesion;   /* work of adhesion of the approach [J/m^2]; NaN: fitted without
                                       adhesion */
    double pull_off_force; /* pull-off force of the retract [N], 0 if not significant; NaN: no
                              retract */
    double pull_off_work;  /* work of adhesion for the pull-off force [J/m^2], an upper bound; NaN
                              for a thin sample and if no value from 1e-9 to 1e3 gives that force */
    wt_estimate contact_pull; /* constant attractive force of long range (DMT, capillary) [N]; NaN:
                                 fitted without */
    double tabor_number;      /* Tabor number of the larger work of adhesion */
    double loss; /* hysteresis loss of the retract over the work of the approach; NaN: no retract */
    double loss_bias;  /* bias of an elastic fit relative to the modulus, which is then |E*| at
                          1/loading time; 0: no hereditary response in the approach; NaN: no loss,
                          unknown power, or a fit with spectrum or adhesion */
    double piezo_rate; /* [m/s], NaN if no time */
    double indentation_rate; /* mean in contact [m/s], NaN if no time */
    double load_time; /* time from contact to the end of the fitted range [s], NaN if no time */
    double
        second_minimum_ratio; /* cost of the second best contact point over the best; NaN if none */
    double second_contact_point; /* [m], NaN if none */
    double sensitivity_gain;     /* d ln E / d ln sensitivity with contact point and baseline
                                    refitted: 15.6 means that 1 % changes E by 15.6 %. For a single
                                    point at known contact it would be 1 + (contact stiffness)/k */
    double misfit_error; /* contribution of lack of fit to the standard error of the modulus [Pa] */
    double contact_misfit_error; /* contribution of lack of fit to that of the contact point [m] */
    double baseline_length;      /* piezo travel before contact [m] */
    double misfit_length;        /* piezo travel of `misfit`, from contact to the end [m] */
    wt_estimate
        spectrum_factor;  /* modulus over |E*| of the spectrum; NaN without spectrum or times */
    double direction;     /* +1: the height rises into the sample, -1: it falls */
    size_t contact_index; /* sample of the contact point in the approach */
    size_t n_fitted;      /* samples used */
    double loss_power; /* power of time of the hereditary response with the same loss, used in the
                          fit; NaN as loss_bias */
    /* Relative to the modulus: correction of the value for that power, and its error, which is
     * common to all curves of one rubber. */
    double loss_shift, loss_error;
    double baseline_curvature; /* coefficient of the squared position in the baseline [N/m^2] */
    double
        contact_by[WT_CONTACT_ESTIMATORS]; /* contact points of other estimators minus contact_point
                                              [m]; NaN: not requested or not found */
    double fitted_from; /* indentation at the start of the fitted range [m]; 0: contact */
    /* Optical interference: a sine in the baseline (one false alarm in 1000 baselines), fitted
     * together with all other parameters. Amplitude [N], 0: none; period [m], NaN: none. Its phase
     * follows the tip or the height, whichever the contact shows; if that is inconclusive, the
     * errors cover both. */
    double interference_amplitude, interference_period;
    /* Elastic contact fitted to the retract alone, with errors: modulus [Pa], and work or constant
     * force of adhesion of the law that fits better. All NaN if not requested, without a retract
     * that leaves the sample, or without a minimum. */
    wt_estimate retract_modulus, retract_work, retract_pull;
} wt_indent_fit;

/* Scratch memory for curves of any length; one per thread. */
typedef struct wt_indent_workspace wt_indent_workspace;
WT_API wt_indent_workspace *wt_indent_workspace_new(void);
WT_API void wt_indent_workspace_free(wt_indent_workspace *workspace);

/* Fits one approach: height [m] (piezo extension; the direction follows from the data), force [N],
 * time [s] or NULL, n samples in order of time, spring constant [N/m]. A curve that cannot be
 * fitted is not an error: the function returns WT_OK and a verdict. WT_E_ARG for n = 0 or a spring
 * constant <= 0. options NULL = wt_indent_defaults(). */
WT_API wt_status wt_indent_fit_curve(const wt_contact_table *table,
                                     const wt_indent_options *options, const double *height,
                                     const double *force, const double *time, size_t n,
                                     double spring_constant, wt_indent_workspace *workspace,
                                     wt_indent_fit *fit, wt_error *err) WT_NODISCARD;
/* Fits the approach of a force curve as it was read. */
WT_API wt_status wt_indent_fit_force_curve(const wt_contact_table *table,
                                           const wt_indent_options *options,
                                           const wt_force_curve *curve,
                                           wt_indent_workspace *workspace, wt_indent_fit *fit,
                                           wt_error *err) WT_NODISCARD;
/* Computes indentation delta [m] and force above the baseline [N] of the samples from contact on,
 * for plots. delta, force: [n]; returns their number. */
WT_API size_t wt_indent_plot_points(const wt_indent_fit *fit, const double *height,
                                    const double *force, size_t n, double spring_constant,
                                    double *delta, double *out_force);

/* Mean residual of curves of one tip and depth against the scatter between curves. It reveals lack
 * of fit that is hidden in the noise of one curve. */
typedef struct wt_pooled_misfit {
    size_t n;
    double misfit; /* root mean square over the contact, relative to the largest force */
    double chance; /* p value for scatter alone; NaN with fewer than 12 curves */
} wt_pooled_misfit;
/* misfit: coefficients of each fit. */
WT_API wt_pooled_misfit wt_pooled_misfit_compute(const double (*misfit)[WT_MISFIT_TERMS], size_t n);

/* Residual of one curve for the analysis of the modulus against depth. The curves have one tip,
 * cantilever and depth, and one contact point each; a fit with one modulus hides most of a change
 * with depth. */
typedef struct wt_curve_residuals {
    double modulus, depth, spring_constant; /* modulus [Pa] and spring constant [N/m] of the fit;
                                               largest indentation [m] */
    double baseline, window; /* piezo travel before contact and in the misfit window [m] */
    double misfit[WT_MISFIT_TERMS];
    long spot;
    double curvature;  /* baseline curvature, which may continue in contact [N/m^2] */
    double loss_error; /* systematic error of the modulus by loss; NaN: loss with unknown bias */
} wt_curve_residuals;

#define WT_DEPTH_MARGIN 0.1 /* irrelevant relative change */
typedef enum wt_depth_verdict {
    WT_DEPTH_INCONCLUSIVE,
    WT_DEPTH_SAME,           /* the interval of the change is within the margin */
    WT_DEPTH_CHANGES,        /* p < 0.01 */
    WT_DEPTH_OTHER_RESIDUAL, /* there is a residual, but not one of a modulus that changes with
                                depth */
} wt_depth_verdict;

enum { WT_DEPTHS = 5 };
typedef struct wt_modulus_profile {
    size_t n,
        n_units; /* number of curves; of spots, or of curves if there are fewer than three spots */
    bool by_spot;
    wt_depth_verdict verdict;
    double depth[WT_DEPTHS]; /* equidistant depths up to the largest [m] */
    wt_interval
        modulus[WT_DEPTHS]; /* of the rubber that would give that force at that depth alone */
    wt_interval change;     /* the last over the first */
    double chance;          /* of a larger change by scatter alone */
    double misfit_p;        /* of a larger residual of another shape */
    /* If a layer thinner than the indentation makes the change; NaN where the curves do not tell
     * all three. */
    wt_interval layer_modulus, ground_modulus, thickness;
    size_t n_excluded_by_loss; /* curves excluded because the effect of loss on them is unknown; no
                       verdict if half of all */
    double bend_share,
        loss_share; /* shares of baseline curvature and loss in the variance of the change */
} wt_modulus_profile;
/* The scatter then has as many degrees of freedom as the residual has cosines. */
enum { WT_DEPTH_MIN_CURVES = 2 * WT_MISFIT_TERMS };
/* Fits the modulus against depth. Fewer than WT_DEPTH_MIN_CURVES curves are inconclusive. The
 * intervals include the effect of a common baseline curvature that continues in contact, and the
 * error of the hereditary response for loss. */
WT_API wt_status wt_modulus_profile_fit(const wt_contact_table *table, double poisson_ratio,
                                        const wt_curve_residuals *curve, size_t n,
                                        wt_modulus_profile *depth, wt_error *err) WT_NODISCARD;

/* Thickness of a layer in the track from the curves alone. A thickness is allowed if the curves
 * change with depth as those of a layer of this thickness on the bulk, with the measured ratio of
 * the moduli. The change of the bulk curves is subtracted, so that effects of tip, loss or piezo
 * common to both cancel. */
enum { WT_LAYER_STEPS = 96 };
typedef enum wt_layer_bound_kind {
    WT_LAYER_BOUND_UNKNOWN,     /* no information, of track or bulk */
    WT_LAYER_BOUND_OUTSIDE_LAW, /* the law does not cover a thick layer of that ratio */
    WT_LAYER_BOUND_ANY,         /* all thicknesses down to `least` are allowed */
    WT_LAYER_BOUND_LOWER,       /* lower bound only */
    WT_LAYER_BOUND_UPPER,       /* upper bound only */
    WT_LAYER_BOUND_BOTH,        /* both bounds */
    WT_LAYER_BOUND_EMPTY,       /* no thickness agrees with the curves */
} wt_layer_bound_kind;
typedef struct wt_layer_profile {
    wt_layer_bound_kind says;
    size_t n[2], n_units[2];      /* number of curves and of units of bulk and track */
    double depth, contact_radius; /* means of the track at the largest indentation [m] */
    double least;                 /* smallest thickness that the law covers [m] */
    bool below;                   /* thinner layers are not covered and therefore allowed */
    /* 95 % interval [m]; low 0, high infinite: unbounded; value NaN unless both bounds exist. */
    wt_interval thickness;
    size_t n_steps; /* grid from thick to thin: */
    double log_thickness[WT_LAYER_STEPS];
    double deviate[WT_LAYER_STEPS]; /* deviation from such a layer as a standard normal variable */
} wt_layer_profile;
/* Computes the profile from bulk (0) and track (1). log_ratio: ln of the modulus of the track over
 * that of the bulk with its error, which has ratio_df degrees of freedom (infinite: normal). Fewer
 * than 12 curves of either, or an unknown ratio, give no information. */
WT_API wt_status wt_layer_profile_compute(const wt_contact_table *const table[2],
                                          double poisson_ratio,
                                          const wt_curve_residuals *const curve[2],
                                          const size_t n[2], wt_estimate log_ratio, double ratio_df,
                                          wt_layer_profile *profile, wt_error *err) WT_NODISCARD;
/* Returns the equivalent modulus of a layered sample over the modulus of the bulk at a contact
 * radius [m]. The layer has the ratio of the track where the contact radius is that of the profile.
 * NaN outside of the range of the law. */
WT_API double wt_layer_modulus(const wt_layer_profile *profile, double ratio, double thickness,
                               double contact_radius);

/* Thicknesses within this factor agree: the steady state of a layer depends on constants that are
 * known to an order of magnitude only. */
#define WT_LAYER_MARGIN 2.0
typedef struct wt_layer_agreement {
    /* 95 % interval of the thickness by both [m]; 0, infinity: unbounded; NaN: none. */
    double low, high;
    double ratio_low,
        ratio_high;     /* thickness by the curves over the other; 0, infinity: unbounded */
    bool differ, agree; /* p < 0.01; interval of the ratio within the margin */
} wt_layer_agreement;
/* Compares the profile with an independent thickness [m] and its 95 % interval. */
WT_API wt_layer_agreement wt_layer_compare(const wt_layer_profile *profile, wt_interval other);

/* ---- groups and their comparison ------------------------------------------------------------- */

/* One group of moduli, accepted curves only. spot[i] numbers the position on the sample, as curves
 * on one spot are not independent. NULL = each curve is its own spot, which the result states. */
typedef struct wt_group {
    const double *modulus; /* [n] Pa, > 0 */
    const long *spot;      /* [n] or NULL */
    const double *rate;    /* [n] indentation rate [m/s]; NULL = one rate for all curves */
    const long
        *rate_class; /* [n], with `rate`: number of the nominal rate, common to both groups */
    size_t n;
    size_t n_rejected;
    double spot_scatter; /* known standard deviation of ln E between spots, for a group of one spot;
                            0 = unknown */
} wt_group;

typedef struct wt_group_summary {
    size_t n, n_rejected, n_spots;
    double mean, standard_deviation; /* of the curves [Pa] */
    double geometric_mean;           /* of the units (spots or curves) [Pa] */
    double log_standard_error;       /* standard error of its logarithm */
    double df;                       /* degrees of freedom of that error (Student's t) */
    double low, high;                /* 95 % interval of the geometric mean [Pa] */
    double median;                   /* of the curves [Pa] */
} wt_group_summary;

/* Method that makes the rates of the two groups comparable. */
typedef enum wt_rate_matching {
    WT_RATES_COMMON,  /* only the common rates, or no rates */
    WT_RATES_WITHIN,  /* slope of ln E against ln rate within the spots */
    WT_RATES_BETWEEN, /* slope between the spots, each of one rate */
} wt_rate_matching;

/* Reason why there is no interval. */
typedef enum wt_verdict_undecided_reason {
    WT_UNDECIDED_NOT,
    WT_UNDECIDED_ONE_SPOT, /* one spot in a group and fewer than three in the other: the scatter
                    between spots is unknown */
    WT_UNDECIDED_NO_COMMON_RATE, /* no common rate and no slope */
    WT_UNDECIDED_SLOPES_DIFFER   /* no common rate, and the slopes of the groups differ */
} wt_verdict_undecided_reason;

typedef struct wt_comparison {
    wt_group_summary bulk, track;     /* of all curves */
    bool by_spot;                     /* the unit of analysis is the spot */
    size_t n_bulk, n_track;           /* number of compared units */
    size_t curves_bulk, curves_track; /* number of curves of these rates */
    wt_rate_matching rate_matching;
    wt_verdict_undecided_reason unsettled;
    bool scatter_is_stated;              /* the interval uses the spot_scatter of the groups */
    wt_estimate log_ratio;               /* ln(E_track / E_bulk) */
    double df;                           /* degrees of freedom of its standard error */
    double ratio, ratio_low, ratio_high; /* with 95 % interval; NaN if unsettled */
    double t, p;                         /* two-sided, of ln(E_track / E_bulk) */
    double effect_size;                  /* Hedges g of ln E, track minus bulk */
    double scatter;                      /* standard deviation of ln E between the units */
    double offset_variance_share;        /* share of `offset` in the variance */
    double mann_whitney_u; /* number of pairs in which the track is stiffer; ties count half */
    double mann_whitney_p; /* two-sided */
    double mann_whitney_smallest_p; /* smallest possible p for these numbers of units */
    bool mann_whitney_exact; /* exact for small samples without ties; else normal, corrected for
                                ties */
    wt_estimate rate_slope;  /* d ln E / d ln rate within the spots; NaN if unknown */
    double interaction_p;    /* p value for equal slopes of the two groups; NaN if unknown */
} wt_comparison;

/* Comparison of the means of a further property of the curves (such as adhesion). */
typedef struct wt_mean_comparison {
    double mean[2];     /* mean of the spots; NaN: no values */
    double larger_p[2]; /* one-sided p value (Welch) that this group is larger than the other;
                                NaN with fewer than two spots in a group */
} wt_mean_comparison;
/* values: [n] one per curve; values that are not finite are excluded. spots: [n], NULL: each curve
 * is a unit. */
WT_API wt_status wt_compare_means(const double *const values[2], const long *const spots[2],
                                  const size_t n[2], wt_mean_comparison *signs,
                                  wt_error *err) WT_NODISCARD;
/* Returns the combined p value of two independent tests (Fisher 1932). If one is NaN, it returns
 * the other. */
WT_API double wt_combined_p_value(double a, double b);
/* Effect of tip wear: a curve of a pyramid or cone with another cap radius [m], fitted by the law
 * of the stated tip. depth [m]; bending: cantilever deflection at that depth [m]. Result: ln of the
 * fitted over the true modulus, and the root mean square residual over the largest force. */
typedef struct wt_tip_wear {
    double log_modulus, misfit;
} wt_tip_wear;
WT_API wt_status wt_tip_wear_fit(const wt_tip *stated, double radius, double depth, double bending,
                                 wt_tip_wear *fit, wt_error *err) WT_NODISCARD;
/* Summarises a group. WT_E_EMPTY for n = 0, WT_E_RANGE for a modulus that is not positive. The
 * interval of one unit is NaN. */
WT_API wt_status wt_group_summarise(const wt_group *group, wt_group_summary *summary,
                                    wt_error *err) WT_NODISCARD;
/* Compares two groups of moduli: Welch, Biometrika 34 (1947) 28, with the degrees of freedom of
 * Satterthwaite, Biometrics Bull. 2 (1946) 110; Mann and Whitney, Ann. Math. Stat. 18 (1947) 50;
 * Hedges, J. Educ. Stat. 6 (1981) 107. The units are spots if both groups name them, else curves.
 * `offset` is a known contribution to ln(E_track / E_bulk), such as a temperature difference or
 * separate cantilevers, with its standard error; NULL = none. WT_E_EMPTY for a group without
 * curves, WT_E_RANGE for a modulus that is not positive or groups without any scatter. */
WT_API wt_status wt_compare_moduli(const wt_group *bulk, const wt_group *track,
                                   const wt_estimate *offset, wt_comparison *result,
                                   wt_error *err) WT_NODISCARD;
/* Returns the smallest number of spots in each group that detects a difference `log_ratio` of ln E
 * with a power of 80 % when spots scatter by `scatter`; 0 if 1000 are not enough. */
WT_API size_t wt_required_spots(double log_ratio, double scatter);
/* Logarithm of a ratio with its error. */
typedef struct wt_log_ratio {
    double value, standard_error;
    double df; /* degrees of freedom of the error; NaN: normal */
} wt_log_ratio;
/* Difference a - b of two independent log ratios (Welch, Satterthwaite as above). Undetermined
 * values are NaN. */
typedef struct wt_log_ratio_difference {
    double value, low, high; /* with its 95 % interval */
    double df;               /* NaN: normal error */
    double p;                /* two-sided, for no difference */
} wt_log_ratio_difference;
WT_API wt_log_ratio_difference wt_log_ratio_compare(const wt_log_ratio *a, const wt_log_ratio *b);
/* Adjusts n p values by Holm's correction (Scand. J. Stat. 6 (1979) 65); adjusted: [n]. NaN values
 * stay and are not counted. */
WT_API void wt_holm_adjust(const double *p, size_t n, double *adjusted);
/* Returns the equivalent angular frequency [rad/s] of a loading of time t [s] with F ~ delta^p:
 * exp(psi(p+1))/t (2.52/t for p = 2, 2.02/t for p = 1.5). NaN for t <= 0. */
WT_API double wt_equivalent_frequency(double load_time, double force_exponent);

/* ---- peaks and values of a curve against temperature --------------------------------------- */

/* Maximum of a curve of scattered points. The errors are due to the scatter of the points, not to
 * the thermometer. */
typedef struct wt_peak {
    bool found;
    wt_interval at,
        height;          /* NaN if not found; bounds that too few points determine are NaN, too */
    size_t n;            /* points used */
    double misfit;       /* root mean square deviation from the curve, relative to the height */
    const char *why_not; /* "" or the reason why it is not found or not bounded; static */
} wt_peak;
/* Finds the peak; x increasing, y > 0. The curve is a parabola of ln y plus a Gaussian process,
 * down to half the height. With `points` > 0 it is a plain parabola of y through so many points
 * about the largest. A largest point that is one of the outer two on a side is no peak. */
WT_API wt_status wt_peak_find(const double *x, const double *y, size_t n, size_t points,
                              wt_peak *peak, wt_error *err) WT_NODISCARD;
/* Finds further maxima in order of x: each in its range between adjacent minima, above which it
 * rises by a tenth at least, fitted as in wt_peak_find. Stores at most `most`; *n_peaks is their
 * number. */
WT_API wt_status wt_secondary_peaks(const double *x, const double *y, size_t n, size_t most,
                                    wt_peak *peaks, size_t *n_peaks, wt_error *err) WT_NODISCARD;
/* Extrapolated onset of the fall of the storage modulus (ASTM E1640): intersection of the tangent
 * of ln y at its steepest fall with the tangent of the glass, at the lower temperature where the
 * slope is a tenth of that. */
typedef struct wt_onset {
    bool found;
    wt_interval at;      /* NaN if not found */
    size_t n;            /* points used */
    const char *why_not; /* "" or the reason why it is not found; static */
} wt_onset;
/* Finds the onset; x increasing, y > 0. The curve is that of wt_peak_find through the points about
 * the fall. */
WT_API wt_status wt_onset_find(const double *x, const double *y, size_t n, wt_onset *onset,
                               wt_error *err) WT_NODISCARD;
/* Returns the value of such a curve through the neighbours of x = `at`; NaN outside of the points.
 */
WT_API wt_status wt_smooth_interpolate(const double *x, const double *y, size_t n, double at,
                                       wt_interval *value, wt_error *err) WT_NODISCARD;

/* ---- strain sweeps (Payne effect) ------------------------------------------------------------ */

/* Law of Kraus (1984), as in Rutherford et al., Polymers 15 (2023) 1675
 * (doi:10.3390/polym15071675):
 * storage = storage_inf + (storage_0 - storage_inf) / (1 + x^2),
 * loss = loss_inf + (loss_m - loss_inf) 2 x / (1 + x^2), x = (strain / strain_c)^exponent. */
typedef struct wt_kraus {
    double storage_0, storage_inf, strain_c, exponent, loss_m, loss_inf;
} wt_kraus;
WT_API double wt_kraus_storage(const wt_kraus *law, double strain);
WT_API double wt_kraus_loss(const wt_kraus *law, double strain);

/* Result for one strain sweep. Values outside of the measured range are NaN. */
typedef struct wt_payne {
    /* Measured values: means of up to three points with the smallest amplitudes (within a factor of
     * three of the smallest) and of the three largest; amplitudes at which the storage modulus
     * first falls below 0.9 and 0.5 of its start, interpolated in ln strain; the largest loss
     * modulus, and its amplitude unless that is one of the outer two on a side. */
    double storage_start, loss_start, storage_end;
    double strain_tenth, strain_half, loss_max, strain_loss_max;
    /* Least squares with equal errors of the storage moduli; the loss moduli then use its strain_c
     * and exponent. Intervals follow from the profiled sum of squares; bounds that the points do
     * not determine are NaN. strain_c is the amplitude of half the fall. */
    bool fitted;
    wt_kraus law;
    wt_interval storage_0, storage_inf, strain_c, exponent, loss_m, loss_inf;
    double storage_misfit,
        loss_misfit;       /* root mean square deviations over storage_0 and loss_max */
    const char *note;      /* "", or a reason for no fit or a remark; static */
    const char *loss_note; /* the same for the loss modulus */
} wt_payne;
/* Fits a strain sweep. strain increasing; strain and moduli > 0. loss NULL: not measured, and its
 * results are NaN. */
WT_API wt_status wt_payne_fit(const double *strain, const double *storage, const double *loss,
                              size_t n, wt_payne *payne, wt_error *err) WT_NODISCARD;

/* ---- dwells ---------------------------------------------------------------------------------- */

/* An approach, the following dwell and retract, in order of time. */
typedef struct wt_dwell_history {
    const double *time;     /* [n] [s], rising; n = n_approach + n_dwell + n_retract */
    const double *position; /* [n] height [m], rising into the sample */
    const double *force;    /* [n] [N], as measured */
    size_t n_approach, n_dwell,
        n_retract;          /* n_retract may be 0; the retract shows the drift of the force */
    double spring_constant; /* [N/m] */
    double poisson_ratio;
    double contact_point, modulus; /* initial values from a fit of the approach [m], [Pa] */
    double baseline_offset;        /* initial value [N] */
    wt_estimate baseline_tilt;     /* initial value [N/m] */
} wt_dwell_history;

/* Mean of a part of the dwell. */
typedef struct wt_dwell_point {
    double time, force,
        indentation; /* time from contact [s]; force above the baseline [N]; indentation [m] */
    double modulus, fitted; /* modulus of an elastic sample with this force and indentation [Pa],
                               and its value in the fit */
} wt_dwell_point;
/* Storage and loss modulus at one frequency. The errors include noise, contact point, baseline,
 * drift and the uncertainty of the spectrum outside the measured times. They do not include
 * cantilever, tip and sensitivity. The part that is common to curves of one kind, from the
 * assumptions on drift and spectrum, is given separately. */
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
    double drift, drift_start;       /* of the force [N/s], since that time [s] */
    double indentation_common_error; /* of the indentation at the end [m], what curves of one kind
                                        share; NaN as below */
    double misfit, misfit_p; /* sum of squares over its degrees of freedom, by which the errors
                                     are wider where it is above 1; chance of more by noise: below
                                     0.01 the errors are not known (NaN) */
    size_t n, n_points;
    wt_dwell_moduli moduli[WT_DWELL_FREQUENCIES]; /* four per decade, 10^(i/4) rad/s, between the
                                                     inverse times from contact of the dwell */
    wt_dwell_point point[WT_DWELL_POINTS];
} wt_dwell;
/* Fits the relaxation modulus to approach and dwell, with contact point, baseline and drift. It
 * uses the hereditary integral of Lee and Radok with the measured heights; the indentation must not
 * fall. It returns the storage and loss modulus of the fit. */
WT_API wt_status wt_dwell_fit(const wt_contact_table *table, const wt_dwell_history *history,
                              wt_dwell *dwell, wt_error *err) WT_NODISCARD;

/* A sine in height and force: complex amplitudes A (real and imaginary part) of A exp(i omega (t -
 * start)). */
typedef struct wt_modulation {
    bool found;
    const char *why_not;       /* "" or the reason why there is none; static */
    double angular_frequency;  /* [rad/s] */
    double start;              /* [s] */
    double amplitude[4];       /* of height [m] and force [N] */
    double mean_time, mean[2]; /* weighted means: time [s], height [m] and force [N] */
} wt_modulation;
/* Fits the modulation by least squares with Hann weights, together with a cubic polynomial and a
 * logarithm of the time. angular_frequency: drive frequency [rad/s], or NaN: the strongest of the
 * height. A height that moves no more than its noise has no modulation. */
WT_API wt_status wt_modulation_fit(const double *time, const double *position, const double *force,
                                   size_t n, double angular_frequency, wt_modulation *modulation,
                                   wt_error *err) WT_NODISCARD;
/* Subtracts the modulation from its samples. */
WT_API void wt_modulation_remove(const wt_modulation *modulation, const double *time, size_t n,
                                 double *position, double *force);
/* Computes E* = k* / slope with the dynamic contact stiffness k*; slope = dF/ddelta of the tip over
 * the modulus at the mean depth [m]. air: the same drive away from the sample, for the correction
 * of drag and crosstalk; NULL: none. The errors are NaN, as those of noise and depth covered the
 * truth in only 88 % of simulated curves. The scatter of several modulations gives them. */
WT_API wt_status wt_modulation_moduli(const wt_modulation *modulation, const wt_modulation *air,
                                      double spring_constant, double slope, wt_dwell_moduli *moduli,
                                      wt_error *err) WT_NODISCARD;

/* ---- deflection sensitivity: curves on a hard surface ---------------------------------------- */

/* Part of the contact for the slope: shares of the rise of the signal. */
typedef struct wt_slope_options {
    double from, to;
} wt_slope_options;
WT_API wt_slope_options wt_slope_defaults(void);
WT_API const wt_params *wt_slope_params(void);

/* Slope of one direction of a curve. Errors are due to the scatter within it, with `freedom`
 * degrees of freedom. Lines are fitted to the means of as many blocks of samples, so that noise
 * shorter than a block is included. */
typedef struct wt_contact_slope {
    bool found;
    char why_not[96];            /* "" or the reason why there is no slope */
    double slope, slope_error;   /* signal against piezo, with the error of the tilt: [unit of the
                                    signal / m] */
    double change, change_error; /* relative change of the slope over the part */
    double tilt;   /* subtracted baseline tilt relative to the slope; NaN: no baseline */
    double misfit; /* root mean square residual over the rise */
    double signal_from, signal_to; /* limits of the part above the baseline */
    double travel;                 /* piezo travel of the part [m] */
    size_t n;                      /* samples in it */
    double freedom;
} wt_contact_slope;
/* Fits the slope. Piezo position [m] of either direction, and the signal, which is larger in
 * contact, in order of time of an approach or a retract. NaN samples are excluded. */
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

/* Interval for averaging friction before its scatter is computed, so that variation within a lap or
 * stroke does not count as scatter. */
typedef enum wt_cycle_kind {
    WT_CYCLE_AUTO,   /* strokes, laps or time intervals, the first that the record allows */
    WT_CYCLE_STROKE, /* one double stroke */
    WT_CYCLE_LAP,    /* whole revolutions */
    WT_CYCLE_TIME,   /* equal time intervals */
    WT_CYCLE_SAMPLE  /* no averaging: each sample */
} wt_cycle_kind;

/* Means over one cycle; channels that were not recorded are NaN. */
typedef struct wt_cycle {
    size_t first, n, step;
    double time, distance, laps; /* at its middle */
    double coefficient;
    double zero;      /* for strokes: mean of both directions, signed, as a coefficient */
    double deviation; /* standard deviation of its samples */
    double normal_force, velocity, pressure, temperature, wear_depth;
    double rotation; /* of the disc [rad/s] */
    double duration; /* to the first sample of the next one [s] */
} wt_cycle;

typedef struct wt_cycles {
    wt_cycle_kind kind;
    size_t n;
    wt_cycle *cycle;
    double *friction;  /* [samples of the record] signed coefficient */
    double samples;    /* median number of samples in a cycle */
    double difference; /* largest difference of mu and friction force over load, if the file has
                          both; NaN */
    bool has_zero;     /* the two directions have opposite signs */
    size_t n_unloaded; /* samples without a coefficient because the load is not positive */
} wt_cycles;
/* Splits a record into cycles. The track `radius` [m] converts distance to laps and rotation to
 * velocity; NaN: unknown. `load` [N] is used if none was recorded; NaN: unknown. WT_E_MISSING if
 * the record does not allow a `kind` other than WT_CYCLE_AUTO. */
WT_API wt_status wt_cycles_compute(const wt_record *record, wt_cycle_kind kind, double radius,
                                   double load, wt_cycles *cycles, wt_error *err) WT_NODISCARD;
WT_API void wt_cycles_clear(wt_cycles *cycles);

/* End of the running-in of a series: a line with its own scatter, then a constant with another.
 * Both scatters are white plus an autoregression of first order. The likelihood is averaged over
 * its length and share, and over the end. */
typedef struct wt_running_in {
    bool seen;       /* odds above 20 to 1 against a series without running-in */
    wt_interval end; /* number of points before the steady state: median and 95 % interval; NaN */
    size_t steady_start; /* first point of the steady state, after the interval; 0: all */
    const char *why_not; /* "" or the reason why there is no end; static */
} wt_running_in;
WT_API wt_status wt_running_in_find(const double *y, size_t n, wt_running_in *running_in,
                                    wt_error *err) WT_NODISCARD;
/* Other rules for the first point of the steady state: one step of the mean by least squares, at
 * least 2 % from either end; MSER-5 of White, Simulation 69 (1997) 323. */
WT_API size_t wt_step_detect(const double *y, size_t n);
WT_API size_t wt_mser_5(const double *y, size_t n);

/* Mean and drift of a steady-state series with correlated scatter. The 95 % intervals are averaged
 * over the uncertainty of the correlation; the mean also over models with and without drift. */
typedef struct wt_steady {
    size_t n;
    wt_interval mean;
    wt_interval drift;          /* per point */
    double deviation, min, max; /* of the points */
    double correlation;         /* variance of the mean over that of as many independent points */
    const char *note;           /* "" or a remark; static */
} wt_steady;
WT_API wt_status wt_steady_mean(const double *y, size_t n, wt_steady *steady,
                                wt_error *err) WT_NODISCARD;

/* Stick-slip: significant falls of the samples that follow slower rises. */
typedef struct wt_stick_slip {
    size_t n;              /* number of slips; 0: none significant */
    double amplitude;      /* mean height of the falls; NaN if none */
    double standard_error; /* from their scatter */
} wt_stick_slip;
WT_API wt_status wt_stick_slip_find(const double *y, size_t n, wt_stick_slip *slips,
                                    wt_error *err) WT_NODISCARD;

/* A wear track in a profile across it: heights relative to a line through the outer quarters. */
typedef struct wt_track {
    bool found; /* two adjacent samples are deeper than 3 standard deviations of the outer quarters
                 */
    double slope, intercept, scatter; /* of the line; standard deviation about it */
    double depth, at, from, to; /* depth and position of the deepest point; limits of the track */
    wt_estimate area; /* area below the line within the limits; error from the line's scatter */
    double ridges;    /* area above the line within the limits */
} wt_track;
/* Finds the track. Positions x increasing and heights z, both [m]. WT_E_RANGE for fewer than 40
 * points. */
WT_API wt_status wt_track_find(const double *x, const double *z, size_t n, wt_track *track,
                               wt_error *err) WT_NODISCARD;

/* ---- thermal noise of a cantilever ----------------------------------------------------------- */

/* Thermal tune: a simple harmonic oscillator (cantilever: Butt and Jaschke, Nanotechnology 6 (1995)
 * 1) on a white floor, one-sided: S(f) = floor + 2 mean_square f0^3 / (pi Q) / ((f0^2 - f^2)^2 + (f
 * f0 / Q)^2). 95 % intervals, normal in the logarithm. */
typedef struct wt_thermal {
    bool found;
    wt_interval mean_square; /* mean square of the oscillator over all frequencies [density Hz] */
    wt_interval resonance;   /* f0 [Hz] */
    wt_interval quality;     /* Q */
    double floor;            /* [density] */
    double from, to;         /* fitted range [Hz] */
    size_t n;                /* points in it */
    double averages;         /* number of averaged spectra according to the scatter about the fit */
    double chance;       /* p value of the slow deviation from the oscillator for scatter alone */
    const char *why_not; /* "" or the reason why there is none; static */
} wt_thermal;
/* Fits an averaged periodogram by maximum likelihood: frequencies [Hz] increasing, densities
 * [unit^2/Hz]. Points without a positive density are excluded. from and to [Hz]: NaN = about the
 * peak. */
WT_API wt_status wt_thermal_fit(const double *frequency, const double *density, size_t n,
                                double from, double to, wt_thermal *thermal,
                                wt_error *err) WT_NODISCARD;

/* ---- Sader's method -------------------------------------------------------------------------- */

typedef enum wt_medium { WT_MEDIUM_AIR, WT_MEDIUM_WATER } wt_medium;
typedef struct wt_fluid {
    double density, viscosity; /* [kg/m^3], [Pa s] */
} wt_fluid;
/* Returns the properties of dry air at 1013.25 hPa (Sutherland's law) or of water (density: Tanaka
 * et al., Metrologia 38 (2001) 301; viscosity: IAPWS) at a temperature [K]; NaN for water that is
 * not liquid. */
WT_API wt_fluid wt_medium_properties(wt_medium medium, double temperature);
/* Computes the hydrodynamic function of a rectangular cantilever at the Reynolds number density
 * omega width^2 / (4 viscosity) > 0 (Sader, J. Appl. Phys. 84 (1998) 64). */
WT_API void wt_hydrodynamic_function(double reynolds, double *real, double *imaginary);
/* Returns k = 0.1906 density width^2 length Q Im Gamma omega^2 of a rectangular cantilever much
 * longer than wide (Sader, Chon and Mulvaney, Rev. Sci. Instrum. 70 (1999) 3967). All values are SI
 * and > 0; their errors are propagated. */
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
    wt_surface_form form; /* polynomial that is subtracted by least squares */
    wt_surface_window window;
    double largest_missing; /* largest share of missing heights; more is an error */
    double points_per_wave; /* smallest reliable number; 2 is the Nyquist wavenumber */
    double tip_radius;      /* [m]; NaN: unknown */
} wt_surface_options;
WT_API wt_surface_options wt_surface_options_defaults(void);

/* Height parameters after form removal: ISO 25178-2 (for a profile ISO 21920-2, where they are
 * called R) over the existing points. Slopes are forward differences of neighbours; Sdr uses the
 * two at a point. Other stencils give other slopes. */
typedef struct wt_surface_heights {
    size_t n, missing;
    double rms, mean_deviation, peak_to_valley; /* Sq, Sa, Sz [m] */
    double skewness, kurtosis;                  /* Ssk, Sku */
    double rms_slope, slope_x, slope_y;         /* Sdq and its components; for a profile along x */
    double area_excess;                         /* Sdr; NaN for a profile */
} wt_surface_heights;

enum { WT_SURFACE_SECTORS = 18 }; /* number of sectors in a half turn */
/* Bin of modes with wavenumbers between 10^((index - 1/2)/10) and 10^((index + 1/2)/10) rad/m. */
typedef struct wt_spectrum_bin {
    int index;
    double wavenumber, mean_wavenumber; /* geometric and arithmetic mean [rad/m] */
    double width;                       /* standard deviation of ln q of its modes */
    double density;                     /* mean density C [m^4] or C1 [m^3], two-sided */
    double deviation;                   /* standard deviation of a mode of a scan */
    size_t n;                           /* number of modes of the full plane or of both signs */
    size_t scans;                       /* number of scans of these modes */
    double freedom; /* degrees of freedom (chi-squared) of the mean; fewer than n, as a window
                       correlates neighbours */
    double shared_freedom; /* its part of the degrees of freedom of all bins, as modes of two bins
                              are correlated, too */
    double cosine, sine;   /* C(phi) = C (1 + cosine cos 2 phi + sine sin 2 phi + */
    double cosine_fourth, sine_fourth; /* the same for 4 phi), phi from x */
    /* Number of modes within half a sector of k pi / WT_SURFACE_SECTORS, and the sum of C of each
     * over the mean of all; none for profiles. */
    double sector_modes[WT_SURFACE_SECTORS], sector_sum[WT_SURFACE_SECTORS];
    double sector_tie; /* number of modes of a sector per independent mode */
    bool reliable;
} wt_spectrum_bin;

/* Power spectrum of a surface, with h_rms^2 = 2 pi int q C dq = 2 int_0^inf C1 dq; q = 2 pi /
 * wavelength. */
typedef struct wt_surface_spectrum {
    wt_spectrum_kind kind;
    size_t n;
    wt_spectrum_bin *bins;
    double from, to;     /* reliable range [rad/m] */
    const char *ends_by; /* "points" or "tip"; static */
    /* For several scans: place_scatter is the standard deviation of ln C between positions, equal
     * at all wavenumbers. place_reach is the value whose 1.96-fold is the half width of an
     * interval; it includes the uncertainty of few positions and the scatter of the modes.
     * place_error is the resulting standard error of the mean: by the scans of each bin, its square
     * averaged over the bins. NaN: unknown. */
    double place_scatter, place_reach, place_error;
    /* Scans of one size contribute equally to all bins and deviate in all bins together,
     * independent of other sizes. n_sizes: number of sizes, 0: not stored. place_part: [n_sizes]
     * per bin, the widest first: standard error of ln C due to one size, over place_reach. */
    size_t n_sizes;
    double *place_part;
} wt_surface_spectrum;
WT_API void wt_surface_spectrum_clear(wt_surface_spectrum *spectrum);

/* Computes height parameters and spectrum: form removal, missing heights filled as a membrane,
 * window, discrete Fourier transform, means over bins. Conventions: Jacobs, Junge, Pastewka, Surf.
 * Topogr. 5 (2017) 013001, but C = C2D / (2 pi)^2 and C1 = C1D / (2 pi). A map of one row gives C1.
 * The range ends at points_per_wave, or where the curvature of peaks reaches half that of the tip
 * (Sanner et al., Appl. Surf. Sci. Adv. 7 (2022) 100190). WT_E_RANGE: too many heights are missing;
 * WT_E_EMPTY: too few points, or all heights are equal. */
WT_API wt_status wt_surface_analyse(const wt_height_map *map, const wt_surface_options *options,
                                    wt_surface_heights *heights, wt_surface_spectrum *spectrum,
                                    wt_error *err) WT_NODISCARD;
/* Combines spectra of one kind: means of ln C over the reliable bins, weighted by their modes and
 * corrected for the bias of a mean of logarithms. WT_E_EMPTY: no bin is reliable. */
WT_API wt_status wt_surface_combine(const wt_surface_spectrum *const *spectra, size_t n,
                                    wt_surface_spectrum *joined, wt_error *err) WT_NODISCARD;
/* Converts C1 of an isotropic surface to C; the slope at the end is extrapolated. Bins that the
 * scatter makes negative, or that are uncertain by more than a factor of two, are excluded.
 * WT_E_RANGE: the end is too flat, or there are too few profiles. */
WT_API wt_status wt_surface_invert(const wt_surface_spectrum *profile, wt_surface_spectrum *surface,
                                   wt_error *err) WT_NODISCARD;
/* Converts C1 [m^3] at wavenumbers [rad/m] to C [m^4], [n], without errors. WT_E_RANGE as above,
 * and where C would not be positive. */
WT_API wt_status wt_surface_from_profile(const double *wavenumber, const double *c1, size_t n,
                                         double *c, wt_error *err) WT_NODISCARD;
/* Returns the density of a bin with its error, including the known scatter between positions. The
 * standard error, and those of c0 and roll_off below, is that of the logarithm times the value. */
WT_API wt_interval wt_surface_density(const wt_surface_spectrum *spectrum, size_t bin);

/* Anisotropy of a spectrum: C(phi) = C (1 + amplitude cos order (phi - direction)), mean over the
 * modes of all reliable bins. Standard errors from the scatter of the modes. */
typedef struct wt_surface_anisotropy {
    double amplitude, direction; /* direction of a maximum, [rad] from x, -pi/order to pi/order */
    double amplitude_error, direction_error;
    double chance; /* p value of the amplitude for scatter alone */
} wt_surface_anisotropy;
/* order: 2 or 4. NaN for profiles. */
WT_API wt_surface_anisotropy wt_surface_anisotropy_fit(const wt_surface_spectrum *spectrum,
                                                       unsigned order);
/* Returns C within half a sector of sector pi / WT_SURFACE_SECTORS from x over that of all
 * directions: mean over the modes of all reliable bins. *modes is their number. NaN without any. */
WT_API wt_interval wt_surface_sector(const wt_surface_spectrum *spectrum, size_t sector,
                                     double *modes);

/* Self-affine law: C = c0 up to roll_off, c0 (q / roll_off)^(-2 (1 + hurst)) above it. */
typedef struct wt_self_affine {
    bool found;
    bool rolls_off; /* false: roll_off is the first wavenumber, without an error */
    wt_interval c0, roll_off, hurst;
    double covariance[3][3];       /* of ln c0, ln roll_off, hurst, including the next */
    double place_covariance[3][3]; /* contribution of the scatter between positions */
    double misfit; /* chi-squared over its degrees of freedom; above 1 it widens the errors */
    size_t n;      /* number of bins */
} wt_self_affine;
/* Fits the law by weighted least squares in ln C over the reliable bins. WT_E_MEMORY. */
WT_API wt_status wt_self_affine_fit(const wt_surface_spectrum *spectrum, wt_self_affine *law,
                                    wt_error *err) WT_NODISCARD;
/* Returns C [m^4] of the law at a wavenumber, NaN if it was not found. The second function returns
 * the standard error of its logarithm (half width of the 95 % interval over 1.96), with or without
 * the contribution of positions. */
WT_API double wt_self_affine_density(const wt_self_affine *law, double wavenumber);
WT_API double wt_self_affine_log_error(const wt_self_affine *law, double wavenumber, bool places);

/* Returns the wavenumber [rad/m] at which the rms slope, from q0 on, reaches `slope`; NaN if it
 * does not. */
WT_API double wt_roughness_slope_wavenumber(const wt_roughness *roughness, double slope);

/* ---- master curve: one spectrum for all isotherms ----------------------------------------------
 */

typedef enum wt_vertical_shift {
    WT_VERTICAL_NONE,
    WT_VERTICAL_PHYSICAL, /* b = rho0 T0 / (rho T) */
    WT_VERTICAL_FREE,
    WT_VERTICAL_TIED /* physical, within clamping scatter and a smooth dependence on temperature,
                        whose size is averaged over */
} wt_vertical_shift;

/* Quantity for the fit of the spectrum and the shifts. */
typedef enum wt_shift_quantity {
    WT_SHIFT_MODULI,     /* both moduli, or those measured for all isotherms */
    WT_SHIFT_STORAGE,    /* E' or G' only */
    WT_SHIFT_LOSS,       /* E'' or G'' only: the equilibrium modulus, and so E', stays unknown */
    WT_SHIFT_LOSS_FACTOR /* tan delta only: no level of the moduli, no vertical shift */
} wt_shift_quantity;

typedef enum wt_reference_choice {
    WT_REFERENCE_TEMPERATURE,   /* reference_temperature */
    WT_REFERENCE_TAN_DELTA_PEAK /* temperature of the tan delta peak at 1 Hz; WT_E_RANGE without a
                                   peak */
} wt_reference_choice;

typedef struct wt_master_options {
    double reference_temperature; /* [K], not necessarily that of an isotherm; NaN (default): the
                                     middle isotherm */
    wt_vertical_shift vertical;   /* default TIED */
    double expansion;             /* volumetric thermal expansion in rho T [1/K], default 0 */
    double terms_per_decade; /* terms of the spectrum per decade; NaN (default): 3, or 10 for sharp
                                lines */
    bool liquid;             /* equilibrium modulus 0 */
    bool series_only;        /* skips the fitted moduli at the points (NaN) and the verdict */
    wt_shift_quantity shift_by; /* default MODULI */
    wt_reference_choice reference_at;
} wt_master_options;
WT_API wt_master_options wt_master_options_defaults(void);
WT_API const wt_params *wt_master_options_params(void);

/* Shift of one isotherm: x_r = log10 w + log_a, y_r = log10 M + log_b. b multiplies the measured
 * values. */
typedef struct wt_master_shift {
    double temperature; /* [K] */
    bool
        determined; /* false: log_a and log_b are NaN and the isotherm is not in the master curve */
    wt_interval log_a, log_b; /* [decade]; log_a is 0 at the reference isotherm */
    double log_b_physical;    /* value of rho T */
    double log_b_material;    /* value at this temperature without clamping scatter */
    wt_interval law;          /* log10 aT of the law at this temperature; NaN without one */
    double overlap;           /* frequency range shared with another isotherm [decade] */
    double noise_factor;      /* noise of this isotherm relative to the others */
    size_t n_outliers;        /* excluded values */
    char note[128];           /* "" or a remark */
} wt_master_shift;

/* Source of the shifts. */
typedef enum wt_shift_route {
    WT_SHIFTS_FROM_SPECTRUM, /* fit of one spectrum to all isotherms */
    WT_SHIFTS_FROM_OVERLAP   /* overlap of the storage moduli of neighbours: one spectrum was not
                              found   or does not fit the isotherms. Only the shifts are returned; their
                              errors include the variation over the overlap */
} wt_shift_route;

typedef enum wt_superposition {
    WT_SUPERPOSITION_HOLDS,
    WT_SUPERPOSITION_FAILS,
    WT_SUPERPOSITION_INCONCLUSIVE
} wt_superposition;

typedef struct wt_posterior wt_posterior;

/* Master curve: one relaxation spectrum, shifts and shift law for all isotherms, with the joint
 * errors. */
typedef struct wt_master {
    wt_deformation deformation;
    wt_loading loading;
    double reference_temperature; /* [K] */
    wt_vertical_shift vertical;
    wt_shift_route shift_route;
    double terms_per_decade; /* of the spectrum */
    size_t n_shifts;
    wt_master_shift *shifts; /* [n_shifts], rising temperature */

    size_t
        n; /* number of measured points of the determined isotherms, ordered by reduced frequency */
    double *log_frequency;          /* [n] log10 of the reduced angular frequency [rad/s] */
    double *log_storage, *log_loss; /* [n] log10 of E' or G' [Pa], vertical shift applied */
    wt_interval *fitted_storage, *fitted_loss; /* [n] log10 of the fitted moduli */
    wt_interval *fitted_loss_factor;           /* [n] log10 of the fitted tan delta */
    double *log_step; /* [n] for step tests: log10 of E(t), or 1/J(t) in creep [Pa], at the reduced
                         time 1/frequency; else NaN */
    wt_interval *fitted_step;         /* [n] the same of the fitted spectrum */
    size_t *isotherm;                 /* [n] index into `shifts` */
    bool *left_out;                   /* [n] excluded as an outlier in a modulus */
    double noise_storage, noise_loss; /* relative standard deviation */
    double correlation;               /* correlation of the noise of adjacent points */
    size_t n_outliers;

    wt_shift_law law;   /* kind WT_LAW_NONE: no law, `no_law_reason` has the reason */
    wt_interval offset; /* deviation of the reference isotherm from the law [decade] */
    wt_interval c1, c2, activation_energy; /* NaN: not a constant of the law */
    double c_correlation;                  /* correlation of c1 and c2 */
    wt_interval slope;         /* d log10 aT/dT at the reference temperature [decade/K] */
    wt_interval pole;          /* [K] */
    double temperature_spread; /* standard deviation of the temperature of an isotherm [K] */
    double law_rms;            /* root mean square of the shifts about the law [decade] */
    char no_law_reason[256];

    wt_prony prony;          /* the spectrum at the reference temperature */
    wt_interval equilibrium; /* [Pa] */
    bool equilibrium_limit;  /* `high` is a one-sided 95 % limit; no other value */

    wt_superposition superposition;
    double lack_of_fit_p, misfit_low, misfit_high;           /* misfit: relative, 95 % interval */
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
 * and noise are found by restricted likelihood (Wood and Fasiolo, Biometrics 73 (2017) 1071), with
 * a noise factor for each isotherm, correlation along it, and exclusion of single outliers.
 * Isotherms and points may be in any order; one isotherm is allowed. options NULL = defaults; log
 * may be NULL.
 *
 * Points with a modulus <= 0 are excluded with a warning. If fewer than four remain in an isotherm,
 * WT_E_RANGE names it. Isotherms that share less than 0.3 decade of frequencies with the others are
 * undetermined, with a note, and not in the master curve. WT_E_NO_OVERLAP if no isotherm can be
 * shifted. WT_E_RANGE for temperatures that are not in kelvin, or a reference that the law does not
 * reach within 0.2 decade. The caller clears `master`. */
WT_API wt_status wt_master_fit(const wt_sweep *sweep, const wt_master_options *options, wt_log *log,
                               wt_master *master, wt_error *err) WT_NODISCARD;
/* Returns log10 aT of the law at a temperature [K]; NaN without a law, and outside of the isotherms
 * if fewer than four determine it. */
WT_API wt_interval wt_master_log_shift(const wt_master *master, double temperature);
/* Shared shift law of several samples. */
typedef enum wt_shared_law_mode {
    WT_SHARED_LAW_NONE,   /* one law for each sample */
    WT_SHARED_LAW_SAME,   /* equal constants at one reference temperature */
    WT_SHARED_LAW_SHIFTED /* equal constants, with a reference temperature for each sample */
} wt_shared_law_mode;

typedef struct wt_shared_law_member {
    bool used;
    char why_not[64];
    wt_interval moved; /* its reference temperature above that of the first used sample [K] */
} wt_shared_law_member;

/* An isotherm of a used sample. Shifts in decades, without the offset of the sample. */
typedef struct wt_shared_law_point {
    size_t sample;
    double temperature; /* [K] */
    double log_a, log_a_error;
    wt_interval law;        /* shared law */
    wt_interval difference; /* law of the sample minus the shared law, relative to the middle of its
                               isotherms, with conservative bounds; NaN if not computed */
} wt_shared_law_point;

typedef struct wt_shared_shift_law {
    wt_law_kind kind; /* WLF or Arrhenius */
    double reference; /* [K], of the first used sample */
    wt_interval c1, c2, activation_energy;
    double c_correlation; /* correlation of C1 and C2 */
    double spread;        /* standard deviation of the temperature of an isotherm [K] */
    double p;             /* p value that samples with one law differ so much; NaN: not computed */
    size_t n_members, n;
    wt_shared_law_member *members; /* [n_members] in the order of the samples */
    wt_shared_law_point *points;   /* [n] */
} wt_shared_shift_law;
WT_API void wt_shared_shift_law_clear(wt_shared_shift_law *common);
/* Fits a shared law by generalised least squares over the shifts of all samples with their
 * covariance. There is an offset for each sample, and one temperature error of all isotherms, which
 * is averaged over. The law is WLF if one sample alone has a WLF law, else Arrhenius. Samples with
 * joined laws, given shifts or without a fit (NULL) are excluded. `reference` NaN: that of the
 * first used sample. The caller clears `common`. WT_E_RANGE for fewer than two samples, or if no
 * law describes them. */
WT_API wt_status wt_shared_shift_law_fit(const wt_master *const *masters, size_t n,
                                         wt_shared_law_mode how, double reference,
                                         wt_shared_shift_law *common, wt_error *err) WT_NODISCARD;
/* Returns log10 aT of an isotherm by the closed form of ISO 18437-6 (Gergesova, Zupancic, Saprunov
 * and Emri, J. Rheol. 55 (2011) 1), for comparison. It uses only storage moduli of neighbours,
 * without a vertical shift. NaN if neighbours share too little. */
WT_API double wt_master_closed_form(const wt_master *master, size_t isotherm);
/* Returns the quantity of the fit: WT_SHIFT_MODULI only if both moduli were measured. */
WT_API wt_shift_quantity wt_master_shift_quantity(const wt_master *master);
/* Returns the measured tan delta at point i of the master curve; NaN if not measured. */
WT_API double wt_master_loss_factor(const wt_master *master, size_t i);
/* Computes log10 E' and log10 E'' [Pa] at the reference temperature. Only one thread at a time may
 * use a master. */
WT_API void wt_master_moduli(const wt_master *master, double angular_frequency,
                             wt_interval *log_storage, wt_interval *log_loss);
/* Computes log10 of the relaxation spectrum H, the modulus per unit of ln tau [Pa], at the
 * relaxation time of a term of the series; NaN outside of the measured frequencies. */
WT_API void wt_master_spectrum(const wt_master *master, size_t term, wt_interval *log_density);
/* Draws one sample of the posterior: series at the reference temperature, law, and log10 b of the
 * material at the isotherms (log_b: [n_shifts], NaN where not determined; or NULL). The draw
 * depends only on seed and index. */
WT_API wt_status wt_master_draw(const wt_master *master, uint64_t seed, size_t index,
                                wt_prony *prony, wt_shift_law *law, double *log_b,
                                wt_error *err) WT_NODISCARD;

/* ---- few terms in place of a spectrum ------------------------------------------------------ */

typedef struct wt_reduction {
    unsigned terms;   /* 0 (default): the fewest for the error */
    double error;     /* largest relative deviation of both moduli over the measured frequencies */
    double long_term; /* equilibrium modulus [Pa]; NaN (default): fitted */
} wt_reduction;
WT_API wt_reduction wt_reduction_defaults(void);
WT_API const wt_params *wt_reduction_params(void);
/* Reduces a series to few positive terms with increasing times that approximate both moduli over
 * its frequency range, which must be known. If the number of terms is given, or no number meets the
 * error, it is the closest approximation; check it with wt_prony_deviation. The caller clears `to`.
 */
WT_API wt_status wt_prony_reduce(const wt_prony *from, const wt_reduction *options, wt_prony *to,
                                 wt_error *err) WT_NODISCARD;
/* Computes the largest relative deviations of storage and loss modulus over the frequencies of
 * `from`. */
WT_API void wt_prony_deviation(const wt_prony *from, const wt_prony *to, double deviation[2]);

/* Fit of a fractional Zener law to the points of a master curve that were not excluded, by least
 * squares of the logarithms. It is compared with a series: root mean squares in ln, and Akaike's
 * criterion with small-sample correction (Hurvich and Tsai, Biometrika 76 (1989) 297), smaller is
 * better. There are no errors, because the lack of fit is not noise. */
typedef struct wt_zener_fit {
    double e0, eg, tau, alpha; /* (E0 + Eg z)/(1 + z), z = (i w tau)^alpha; moduli as measured */
    bool determined;           /* the points determine its glass modulus and time */
    double rms_storage, rms_loss, aicc;
    double series_rms_storage, series_rms_loss, series_aicc;
} wt_zener_fit;
WT_API wt_status wt_master_zener(const wt_master *master, const wt_prony *series, wt_zener_fit *fit,
                                 wt_error *err) WT_NODISCARD;

#ifdef __cplusplus
}
#endif
#endif
