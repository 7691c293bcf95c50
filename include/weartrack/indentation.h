/* weartrack - indentation: force curves to moduli. Tips and contact laws; fits of one curve and of
 * groups; images of a spot, deflection sensitivity and spring constant of the cantilever.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WEARTRACK_INDENTATION_H
#define WEARTRACK_INDENTATION_H

#include "weartrack/job.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- tips and contact: F = E/(1-nu^2) G(delta) ---------------------------------------------- */

/* Sneddon, Int. J. Eng. Sci. 3 (1965) 47; pyramid: Rico et al., Phys. Rev. E 72 (2005) 021914. */
typedef enum wt_tip_shape {
    WT_TIP_BLUNTED_PYRAMID, /* n-sided pyramid with a parabolic cap */
    WT_TIP_PARABOLOID,      /* Hertz: G = 4/3 sqrt(R) delta^1.5; a sphere for delta << R */
    WT_TIP_CONE,            /* Sneddon: G = 2/pi tan(theta) delta^2 */
    WT_TIP_SPHERE,          /* Sneddon: delta = a atanh(a/R), G = (a^2 + R^2) atanh(a/R) - a R */
    WT_TIP_PUNCH            /* flat end of radius R: G = 2 R delta */
} wt_tip_shape;
/* All laws assume linear elasticity without friction. The fit rejects a modulus of a sphere,
 * paraboloid or punch deeper than its radius. The sharp pyramid (b = 0) averages over its faces: G
 * = c tan(theta) delta^2 with c = 2/(pi m), 0.7071 for four sides and 0.7698 for three.
 * Three-dimensional solutions give 0.738 and 0.882, so that E is 4 and 15 % too high. */

typedef struct wt_tip {
    wt_tip_shape shape;
    unsigned sides;               /* sides of the pyramid, >= 3; 0 = blunted cone (m = 1) */
    double half_angle;            /* axis to FACE [rad] */
    double radius;                /* radius of cap, sphere or punch [m]; 0 only if b is 0 */
    double transition_radius;     /* radius b where the cap meets the faces [m]; 0 = sharp */
    wt_estimate sample_thickness; /* of rubber on a rigid base [m]; 0 (default) = half-space */
    bool unbonded;                /* the rubber slides on that base */
    /* Standard errors [rad] and [m]; 0 (default) = not stated. The laws do not use them: they are
     * common to all curves of a group. */
    double half_angle_error, radius_error;
} wt_tip;

/* Returns b = R cos(theta), for a sphere tangent to the faces (the default of common AFM programs).
 */
WT_API double wt_tip_tangent_transition(double radius, double half_angle);
/* Checks a tip. WT_E_RANGE states the problem: not finite, radius <= 0, angle outside (0, 90)
 * degrees, or a transition radius that makes the cap concave (b/R > m cot(theta)). */
WT_API wt_status wt_tip_check(const wt_tip *tip, wt_error *err) WT_NODISCARD;
/* Parses a tip: "pyramid:half-angle=35deg,radius=20nm[,sides=4][,transition=12nm]",
 * "sphere:radius=5um", "cone:half-angle=20deg[,radius=20nm][,transition=12nm]" (a blunted cone with
 * a radius), "paraboloid:radius=5um", "punch:radius=2um"; "berkovich:radius=150nm" (3 sides, 65.27
 * degrees from the axis to a face) and "vickers:radius=200nm" (4 sides, 68 degrees).
 * The default transition radius is the tangent one; radius=0nm is a sharp pyramid. Half-angle and
 * radius may have a standard error, "radius=20nm+-15%". WT_E_ARG or WT_E_UNIT for the spelling,
 * else as wt_tip_check. `tip` is unchanged on failure. */
WT_API wt_status wt_tip_parse(const char *text, wt_tip *tip, wt_error *err) WT_NODISCARD;
/* Formats the tip with all its numbers, b included. Returns the length as snprintf does. `tip` must
 * have passed wt_tip_check. */
WT_API size_t wt_tip_describe(const wt_tip *tip, char *buffer, size_t size);

/* Computes G(delta) [m^2] and dG/ddelta = 2a [m] for delta >= 0 (0 and 0 for delta <= 0). Rico et
 * al., Phys. Rev. E 72 (2005) 021914, in a form without cancellation. Relative error below 1e-12.
 * For a thin sample G includes the base, for Poisson's ratio 0.5 if bonded. It then differs from
 * the exact solution by typically 0.4 %, at most 2.5 %, up to a contact radius of one thickness. */
WT_API void wt_contact_function(const wt_tip *tip, double delta, double *g, double *slope);

/* Tabulated G and slope for fast evaluation. One table of a tip serves all curves and threads. It
 * is piecewise quintic beyond the switch depth b^2/R and exact elsewhere. The relative error is
 * below 1e-11 in [delta_min, delta_max]; outside, the direct function is used. WT_E_RANGE as
 * wt_tip_check, and unless 0 < delta_min < delta_max. */
typedef struct wt_contact_table wt_contact_table;
WT_API wt_status wt_contact_table_new(const wt_tip *tip, double delta_min, double delta_max,
                                      wt_contact_table **table, wt_error *err) WT_NODISCARD;
WT_API void wt_contact_table_free(wt_contact_table *table);
WT_API void wt_contact_table_eval(const wt_contact_table *table, const double *delta, size_t n,
                                  double *g, double *slope); /* slope may be NULL */

/* ---- one force curve: baseline, contact point, modulus -------------------------------------- */

/* Verdict on a curve: enumerator, identifier, text. Accepted, wide and doubtful curves have a
 * usable modulus. The tests run in about this order; the first that applies is reported with its
 * numbers: not_finite         more than 10 % of the samples are missing too_short          fewer
 * than 32 different samples, or fewer than 8 in contact no_approach        the height is not
 * monotonic, or the force falls along the segment saturated          the force is constant while
 * the piezo moves, or its slope decreases at the top (a contact force rises ever steeper; one false
 * alarm in 1000), and the part below has no modulus; with a modulus it is doubtful rigid the
 * indentation is less than 2 % of the cantilever deflection, or 1 % of sensitivity would change the
 * modulus by more than 50 % negative_modulus, no_contact   no contact point gives a positive
 * modulus; the largest force is less than 5 times the noise no_baseline        contact before the
 * first sample, or a baseline of fewer than 10 samples A standard error above largest_error times
 * the modulus, with most of its variance from ambiguous_contact  a second, equally likely contact
 * point adhesive           lack of fit, with a snap-in or a pull-off disturbed_baseline lack of
 * fit, with a curved baseline (p below 1 %) poor_fit           other lack of fit; or no convergence
 *   imprecise          noise
 * A modulus that is
 *   wide               with a standard error above doubtful_error, and no other objection
 *   doubtful           deeper than one radius of a sphere or than the range of the thin-sample law;
 *                      of a punch with hysteresis loss; with an unknown error by the misfit or a
 *                      pull that no law describes; with interference on the baseline above 10 % of
 *                      the largest force, peak to peak
 * Verdicts that no fit gives: excluded, unreadable. */
#define WT_CURVE_VERDICT_LIST(X)                                                                   \
    X(WT_CURVE_ACCEPTED, "accepted", "accepted")                                                   \
    X(WT_CURVE_WIDE, "wide", "a modulus with a wide interval")                                     \
    X(WT_CURVE_DOUBTFUL, "doubtful", "a modulus that an effect outside of the law may bias")       \
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
/* Returns true if the modulus is usable: accepted, wide or doubtful. */
WT_API bool wt_curve_verdict_is_usable(wt_curve_verdict verdict);

enum { WT_MISFIT_TERMS = 6 };
/* Ranges of the force that are compared with the whole: 0 to 50 %, 30 to 100 % and 15 to 70 %. */
enum { WT_FIT_RANGES = 3 };

typedef struct wt_indent_options {
    double poisson_ratio; /* default 0.5 */
    /* Range of the fit: all limits apply together; forces are above the baseline; the baseline
     * before contact is always included. */
    double fit_depth;          /* largest indentation [m]; 0 = all (default) */
    double fit_force_fraction; /* largest force over that of the curve; default 1 */
    bool fit_tilt; /* fits the tilt of the baseline, else only the offset; default true */
    double misfit_p_threshold; /* p value below which a residual is lack of fit, for noise as that
                            of the baseline; default 0.01; 0: no test */
    double largest_error; /* largest standard error over modulus of a usable modulus; default 1 */
    double fixed_contact_point; /* [m] tip position, NaN = fitted (default) */
    /* Tip positions [m] between which samples before contact are fitted; NaN = all (default). */
    double baseline_from, baseline_to;
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
    double doubtful_error; /* standard error over modulus above which a curve is wide; default
                              0.2 */
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
    double correlation_length;   /* correlation length of the noise, for components as slow as the
                                    contact [samples] */
    double lack_of_fit;     /* variance of the slow component of the residual in contact over its
                               variance due to baseline noise; the expectation is 1 for a correct
                               contact law; NaN if the baseline is too short */
    double lack_of_fit_p;   /* p value of the lack of fit for noise alone */
    double baseline_p;      /* p value of the baseline curvature for a straight baseline */
    double curvature_shift; /* change of E if the baseline curvature continues in contact [Pa]; 0:
                               no significant curvature */
    double misfit[WT_MISFIT_TERMS]; /* cosine coefficients of the residual over the contact,
                                       relative to max_force */
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
    /* Part of the standard errors of modulus [Pa] and contact point [m] by the misfit of the law:
     * half of the spread over the ranges of the fit beyond the noise. NaN if unknown. */
    double misfit_error, contact_misfit_error;
    /* Relative change of the modulus with each range, and its standard error by noise; NaN with too
     * few samples. */
    double range_shift[WT_FIT_RANGES], range_error[WT_FIT_RANGES];
    double baseline_length; /* piezo travel before contact [m] */
    double misfit_length;   /* piezo travel of `misfit`, from contact to the end [m] */
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
    double fitted_from;        /* indentation at the start of the fitted range [m]; 0: contact */
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

/* ---- curves of one tip: misfit and modulus against depth ------------------------------------ */

/* Mean residual of curves of one tip and depth against the scatter between curves. It reveals lack
 * of fit that is hidden in the noise of one curve. */
typedef struct wt_pooled_misfit {
    size_t n;
    double misfit;  /* root mean square over the contact, relative to the largest force */
    double p_value; /* p value for scatter alone; NaN with fewer than 12 curves */
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
    bool two_spots; /* the curves are of two spots, which allow no interval: its limits are NaN */
    wt_depth_verdict verdict;
    double depth[WT_DEPTHS];        /* equidistant depths up to the largest [m] */
    wt_interval modulus[WT_DEPTHS]; /* modulus of the homogeneous rubber with the same force at this
                                       depth */
    wt_interval change;             /* modulus at the last depth over that at the first */
    double change_p;                /* p value of the change for scatter alone */
    double misfit_p;                /* p value of a residual of another shape */
    /* Constants of a layer that is thinner than the indentation and explains the change. NaN if the
     * curves do not determine all three. */
    wt_interval layer_modulus, substrate_modulus, thickness;
    size_t n_excluded_by_loss; /* curves with an unknown effect of the hysteresis loss, which are
                                  excluded; if they are half of all curves, there is no verdict */
    double curvature_share,
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

/* ---- curves of the track: thickness of a layer ---------------------------------------------- */

/* Thickness of a layer in the track from the curves alone. A thickness is allowed if the curves
 * change with depth as those of a layer of this thickness on the bulk, with the measured ratio of
 * the moduli. The change of the bulk curves is subtracted, so that effects of tip, loss or piezo
 * common to both cancel. */
enum { WT_LAYER_STEPS = 96 };
typedef enum wt_layer_bound_kind {
    WT_LAYER_BOUND_UNKNOWN,     /* no information, of track or bulk */
    WT_LAYER_BOUND_OUTSIDE_LAW, /* the law does not cover a thick layer of that ratio */
    WT_LAYER_BOUND_ANY,         /* all thicknesses down to `smallest_thickness` are allowed */
    WT_LAYER_BOUND_LOWER,       /* lower bound only */
    WT_LAYER_BOUND_UPPER,       /* upper bound only */
    WT_LAYER_BOUND_BOTH,        /* both bounds */
    WT_LAYER_BOUND_EMPTY,       /* no thickness agrees with the curves */
} wt_layer_bound_kind;
typedef struct wt_layer_profile {
    wt_layer_bound_kind bound_kind;
    size_t n[2], n_units[2];      /* number of curves and of units of bulk and track */
    double depth, contact_radius; /* means of the track at the largest indentation [m] */
    double smallest_thickness;    /* smallest thickness that the law covers [m] */
    bool thinner_allowed; /* true if thinner layers are not covered by the law and therefore allowed
                           */
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

/* ---- groups and their comparison ------------------------------------------------------------ */

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
    wt_verdict_undecided_reason undecided_reason;
    bool scatter_is_stated;              /* the interval uses the spot_scatter of the groups */
    wt_estimate log_ratio;               /* ln(E_track / E_bulk) */
    double df;                           /* degrees of freedom of its standard error */
    double ratio, ratio_low, ratio_high; /* with 95 % interval; NaN if unsettled */
    double t, p;                         /* two-sided, of ln(E_track / E_bulk) */
    double effect_size;                  /* Hedges g of ln E, track minus bulk */
    double scatter;                      /* standard deviation of ln E between the units */
    double offset_variance_share;        /* share of `offset` in the variance */
    double mann_whitney_u; /* number of pairs in which the track is stiffer; a tie counts half */
    double mann_whitney_p; /* two-sided */
    double mann_whitney_smallest_p; /* smallest possible p for these numbers of units */
    bool mann_whitney_exact; /* exact for small samples without ties; else normal, corrected for
                                ties */
    wt_estimate rate_slope;  /* d ln E / d ln rate within the spots; NaN if unknown */
    double interaction_p;    /* p value for equal slopes of the two groups; NaN if unknown */
} wt_comparison;

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

/* Adjusts n p values by Holm's correction (Scand. J. Stat. 6 (1979) 65); adjusted: [n]. NaN values
 * stay and are not counted. */
WT_API void wt_holm_adjust(const double *p, size_t n, double *adjusted);
/* Returns the equivalent angular frequency [rad/s] of a loading of time t [s] with F ~ delta^p:
 * exp(psi(p+1))/t (2.52/t for p = 2, 2.02/t for p = 1.5). NaN for t <= 0. */
WT_API double wt_equivalent_frequency(double load_time, double force_exponent);

/* ---- indentation of a group ----------------------------------------------------------------- */

/* Systematic error sources common to all curves of a group, which their scatter does not show. */
typedef enum wt_systematic_source {
    WT_SYSTEMATIC_SPRING_CONSTANT,
    WT_SYSTEMATIC_SENSITIVITY,
    WT_SYSTEMATIC_HALF_ANGLE,
    WT_SYSTEMATIC_RADIUS,
    WT_SYSTEMATIC_PIEZO,     /* bend of the height over the approach, of its travel */
    WT_SYSTEMATIC_DETECTOR,  /* lack of the largest force by a detector that flattens, of it */
    WT_SYSTEMATIC_THICKNESS, /* depth or contact radius, the larger, over the thickness */
    WT_SYSTEMATIC_SOURCES
} wt_systematic_source;

/* One curve that is fitted again and again. It is read at the first call, or again if the values
 * below change. A fixed contact point of the options replaces the one of the manual overrides. */
typedef struct wt_single_curve {
    const char *file; /* as in the column of the table */
    size_t index;
    wt_force_curve curve; /* owned; freed with wt_force_curve_clear */
    bool is_read;
    double spring_constant, sensitivity; /* with which it was read; NaN: those of the file */
} wt_single_curve;

typedef struct wt_indent_job {
    const char *group; /* "bulk", "track" or another name of [a-z0-9_]+ */
    const wt_file_set *sets;
    size_t n_sets;
    wt_tip tip;
    wt_indent_options options;
    /* Values of all curves with their errors (0 = not stated); value NaN: as in the files. */
    wt_estimate spring_constant, sensitivity;
    /* Relative standard errors if the values state none; 0 (default) = none. */
    double lever_error, sensitivity_error;
    /* Standard errors of the linearity of piezo and detector, as WT_SYSTEMATIC_PIEZO and
     * WT_SYSTEMATIC_DETECTOR; 0 (default): not stated. */
    double piezo_error, detector_error;
    bool thick_sample; /* no base has an effect; false (default): unknown without a thickness */
    bool rates;        /* decodes times for the piezo and indentation rates */
    bool median_curve; /* stores the representative curve for the figures */
    /* Curves to store: "median" (which sets median_curve), "rejected", "worst:N", "all", "FILE:N".
     */
    const char *const *curves;
    size_t n_curves;
    const char *choices;            /* file of manual overrides for files and curves; NULL = none */
    const struct wt_rubber *rubber; /* a factor on its spectrum is fitted; NULL (default) = none */
    wt_estimate
        temperature; /* temperature of the curves [K]; NaN = reference temperature of the rubber */
    struct wt_single_curve *only; /* fits this curve alone; NULL (default) = all */
} wt_indent_job;
WT_API wt_indent_job wt_indent_job_defaults(void);
WT_API const wt_params *wt_indent_job_params(void);

/* Tables of indentation, each freed with wt_table_free, all with wt_indent_tables_clear. Initialise
 * with zeros. For a further group, first take `indentation` (set it to NULL); the other tables are
 * appended to. */
typedef struct wt_indent_tables {
    wt_table *indentation;        /* indentation/GROUP, one row per curve, also of rejected ones */
    wt_table *force_displacement; /* NULL unless curves are requested */
    wt_table *force_indentation;
    wt_table *curves;        /* samples of the stored curves; NULL if there are none */
    wt_table *choices;       /* applied manual overrides; NULL without choices */
    wt_table *modulus_depth; /* NULL if no group has enough curves */
    size_t n_files, n_curves, n_accepted, n_failed;
} wt_indent_tables;
WT_API void wt_indent_tables_clear(wt_indent_tables *tables);

/* Fits every curve of every file. Files are streamed and fitted in parallel batches, so that memory
 * is bounded. The order of rows is that of files and curves for any number of threads. WT_E_EMPTY
 * if no file has a curve. */
WT_API wt_status wt_indent_group(const wt_indent_job *job, const wt_job *work,
                                 wt_indent_tables *tables, wt_error *err) WT_NODISCARD;

/* ---- groups of an indentation table --------------------------------------------------------- */

/* Digest of the measured values of a curve, for finding duplicates; 0 = too few values. */
typedef struct wt_curve_digest {
    uint64_t digest;
    size_t item;
} wt_curve_digest;

/* The accepted moduli of an indentation table as a group for comparison. wt_group_data_clear frees
 * the arrays. A duplicate curve counts once. */
typedef struct wt_group_data {
    wt_group group; /* borrows the arrays below */
    double *modulus;
    long *spot;
    const char **spot_name;       /* [n] borrowed from the table */
    double *indentation_rate;     /* [n] m/s, NaN if unknown */
    double *equivalent_frequency; /* [n] rad/s, NaN if unknown */
    double *spectrum_factor;      /* [n] factor on the DMA spectrum, NaN if unknown */
    double *pull; /* [n] largest attractive force of approach and retract [N]; NaN if unknown */
    double *max_force, *max_indentation; /* [n] N, m; NaN if unknown */
    /* of all curves together: mean residual relative to the largest force, and its p value for
     * scatter; NaN if unknown */
    double pooled_misfit, pooled_misfit_p;
    /* [n_fitted] of the curves that were fitted, rejected ones too, for a misfit rejects them: cube
     * root of the lack of fit, number of the spot (not that of the accepted ones) */
    double *lack_of_fit;
    long *fitted_spot;
    size_t n_fitted;
    wt_curve_digest *digest;       /* [n_digests] of the curves, increasing */
    size_t n_digests, n_copies;    /* n_copies: number of excluded duplicates */
    const char *duplicate_file[2]; /* files of the first duplicate; borrowed from the table */
    wt_estimate spring_constant;   /* of the table; NaN if it has none */
    wt_estimate temperature;       /* of the sample, as stated; NaN if it is not */
    double sensitivity_gain;       /* mean of the curves, NaN if unknown */
    wt_estimate sensitivity;       /* stated value; NaN if none or several */
    /* Relative standard errors, NaN if not stated, and the derivative of ln E by each, NaN if
     * unknown. */
    double common_error[WT_SYSTEMATIC_SOURCES];
    wt_estimate common_gain[WT_SYSTEMATIC_SOURCES];
    /* Relative standard errors that are assumed where none is stated, and of the modulus by the
     * shape of the tip, which replaces the assumed ones of the tip; NaN if there is none. */
    double assumed_error[WT_SYSTEMATIC_SOURCES], tip_error;
    double loss_error,
        bend_error; /* systematic errors of all moduli by loss and baseline curvature, the latter
                       with its sign; 0 if not detected, NaN if detected with unknown size */
    double range_error; /* the same by the misfit of the law, as the ranges of the fit show; NaN if
                           no curve has a second range */
    /* Mean relative changes of the moduli with other choices of the fit: each range, with its error
     * by noise, a law without loss, and one with the pull that the fit left out. NaN if unknown. */
    wt_estimate range_shift[WT_FIT_RANGES];
    double loss_shift, pull_shift;
    wt_tip tip;
    bool has_tip;                 /* false: unknown, or several tips */
    bool has_several_cantilevers; /* the curves have several spring constants */
    bool has_several_sensitivities, has_several_tips;
    bool spots_are_named;            /* the user named the spots */
    wt_curve_verdict main_rejection; /* most frequent verdict of the rejected curves */
    size_t n_main_rejection;         /* number of curves with it */
} wt_group_data;

/* ---- images of a spot ----------------------------------------------------------------------- */

typedef struct wt_spot_job {
    wt_tip tip;
    double depth; /* indentation depth [m] */
    double x, y;  /* position in the coordinates of the image [m]; NaN (default) = its middle */
    double position_error; /* [m]; NaN (default) = one contact radius */
    const char *image;     /* part of the name of the image; NULL = first height image */
    wt_read_options read;  /* initialise with wt_read_defaults() */
} wt_spot_job;
WT_API wt_spot_job wt_spot_job_defaults(void);
WT_API const wt_params *wt_spot_job_params(void);
/* Creates the table "spot" of the image `path` before the indentation: roughness over the contact
 * relative to the depth. WT_E_NOT_FOUND if the file has no such height image. */
WT_API wt_status wt_spot_compute(const wt_spot_job *job, const char *path, const wt_job *work,
                                 wt_table **table, wt_error *err) WT_NODISCARD;

/* ---- deflection sensitivity: curves on a hard surface --------------------------------------- */

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
    char reason[96];             /* "" or the reason why there is no slope */
    double slope, slope_error;   /* signal against piezo, with the error of the tilt: [unit of the
                                    signal / m] */
    double change, change_error; /* relative change of the slope over the contact part */
    double tilt;   /* subtracted baseline tilt relative to the slope; NaN: no baseline */
    double misfit; /* root mean square residual over the rise */
    double signal_from, signal_to; /* limits of the part above the baseline */
    double travel;                 /* piezo travel of the part [m] */
    size_t n;                      /* samples in it */
    double df;
} wt_contact_slope;
/* Fits the slope. Piezo position [m] of either direction, and the signal, which is larger in
 * contact, in order of time of an approach or a retract. NaN samples are excluded. */
WT_API wt_status wt_contact_slope_fit(const double *position, const double *signal, size_t n,
                                      const wt_slope_options *options, wt_contact_slope *slope,
                                      wt_error *err) WT_NODISCARD;
/* Returns the mean of n values with its 95 % interval by Student's t. For three or more units
 * (spots, files) it is the mean of the unit means, with *n_units - 1 degrees of freedom; otherwise
 * that of the values. `units` numbers the unit of each value, and values of one unit are adjacent;
 * NULL: no units. For one value the error and the limits are NaN. */
WT_API wt_interval wt_student_mean(const double *values, const long *units, size_t n,
                                   size_t *n_units);

typedef enum wt_curve_direction {
    WT_DIRECTION_BOTH,
    WT_DIRECTION_APPROACH,
    WT_DIRECTION_RETRACT
} wt_curve_direction;

/* Deflection sensitivity from curves on a hard surface. */
typedef struct wt_sensitivity_job {
    const wt_file_set *sets;
    size_t n_sets;
    wt_slope_options options;
    wt_curve_direction directions; /* directions of the result */
    double max_slope_change; /* largest relative change of the slope within the part that counts as
                         straight */
} wt_sensitivity_job;
WT_API wt_sensitivity_job wt_sensitivity_job_defaults(void);
WT_API const wt_params *wt_sensitivity_job_params(void);
typedef struct wt_sensitivity_tables {
    wt_table *sensitivity, *sensitivity_curves;
} wt_sensitivity_tables;
/* WT_E_EMPTY if no file has a curve. If the surface is compliant or the signal is not straight
 * there is no sensitivity; the verdict has the reason. */
WT_API wt_status wt_sensitivity_compute(const wt_sensitivity_job *job, const wt_job *work,
                                        wt_sensitivity_tables *tables, wt_error *err) WT_NODISCARD;

#ifdef __cplusplus
}
#endif
#endif
