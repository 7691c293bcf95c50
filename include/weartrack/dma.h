/* weartrack - dma: DMA sweeps to shift factors, master curve and relaxation spectrum; temperature
 * and strain sweeps; shift laws and viscoelastic materials; export for finite elements.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WEARTRACK_DMA_H
#define WEARTRACK_DMA_H

#include "weartrack/job.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- shift laws ----------------------------------------------------------------------------- */

/* log10 aT = -c1 (T - Tref) / (c2 + T - Tref): Williams, Landel and Ferry, J. Am. Chem. Soc. 77
 * (1955) 3701. */
typedef struct wt_wlf {
    double reference_temperature; /* [K] */
    double c1;                    /* 1 */
    double c2;                    /* [K] */
} wt_wlf;
/* Returns log10 aT; NaN at and below the pole Tref - c2. */
WT_API double wt_wlf_log_shift(const wt_wlf *wlf, double temperature);
/* Returns log10 aT of the Arrhenius law: (Ea / (R ln 10)) (1/T - 1/Tref), Ea in J/mol. */
WT_API double wt_arrhenius_log_shift(double activation_energy, double reference_temperature,
                                     double temperature);

typedef enum wt_law_kind {
    WT_LAW_NONE,
    WT_LAW_WLF,
    WT_LAW_ARRHENIUS,
    WT_LAW_WLF_ARRHENIUS /* WLF above, Arrhenius below a transition temperature (glass) */
} wt_law_kind;
#define WT_LAW_KIND_LIST(X)                                                                        \
    X(WT_LAW_NONE, "none")                                                                         \
    X(WT_LAW_WLF, "WLF")                                                                           \
    X(WT_LAW_ARRHENIUS, "Arrhenius")                                                               \
    X(WT_LAW_WLF_ARRHENIUS, "joined")

typedef struct wt_shift_law {
    wt_law_kind kind;
    wt_wlf wlf;               /* its reference temperature holds for every kind */
    double activation_energy; /* [J/mol] */
    double joint;             /* transition temperature of WT_LAW_WLF_ARRHENIUS [K] */
} wt_shift_law;
/* Returns log10 aT, 0 at the reference temperature. NaN where the law has no value. */
WT_API double wt_shift_law_log_a(const wt_shift_law *law, double temperature);

/* ---- materials ------------------------------------------------------------------------------ */

/* A viscoelastic material: E(w) = E' + i E'' of the isotropic solid, E(-w) = conj E(w). The kernel
 * accesses it only through this table of functions. */
typedef struct wt_material wt_material;

typedef struct wt_material_law {
    const char *name; /* "prony", "table", "fractional_zener", "transverse" */
    /* Computes E'(w) and E''(w) [Pa] at n angular frequencies > 0 [rad/s]. */
    void (*modulus)(const wt_material *material, const double *omega, size_t n, double *storage,
                    double *loss);
    /* Computes the angular integrals in closed form for the plain modulus E (without 1/(1-nu^2)):
     *   J1 = int_0^2pi cos(phi) E''(w cos phi) dphi, J2 = int_0^2pi |E(w cos phi)|^2 dphi.
     * NULL: the kernel integrates `modulus` numerically. */
    void (*angular)(const wt_material *material, const double *omega, size_t n, double *j1,
                    double *j2);
    /* Returns the angular frequencies where the law is not smooth (knots), increasing, borrowed; *n
     * = 0 if none. */
    const double *(*breaks)(const wt_material *material, size_t *n);
    void (*free)(wt_material *material);
    /* Checks that the material is physically possible at frequencies from `low` to `high` [rad/s];
     * else WT_E_RANGE. `statement` (may be NULL) receives a remark on a valid material, or "".
     * NULL: the constructor has checked everything. */
    wt_status (*check)(const wt_material *material, double low, double high, char statement[256],
                       wt_error *err);
    /* Returns the number of terms that `angular` sums. NULL: few. */
    size_t (*terms)(const wt_material *material);
    /* Computes int_0^2pi E''(w cos phi)^2 dphi, the part of J2 from E'', in closed form. NULL: the
     * kernel integrates `modulus`. */
    void (*angular_loss)(const wt_material *material, const double *omega, size_t n, double *j2);
    /* E' and E'' are powers of the frequency below the first break. */
    bool power_below;
} wt_material_law;

struct wt_material {
    const wt_material_law *law;
    double poisson_ratio;                /* [0, 0.5] */
    double frequency_min, frequency_max; /* measured range [rad/s]; NaN = unlimited */
    void *data;                          /* private data of the law */
};

/* Extrapolation outside a table: constant, or with the slope at the end in log-log. The kernel
 * reports the share from outside frequency_min..frequency_max. */
typedef enum wt_extrapolation { WT_EXTRAPOLATE_HOLD, WT_EXTRAPOLATE_SLOPE } wt_extrapolation;

/* Creates a generalised Maxwell model. It copies the series. Shear moduli are converted with E = 2
 * (1 + nu) G. poisson_ratio in [0, 0.5]. */
WT_API wt_status wt_material_prony(const wt_prony *prony, double poisson_ratio,
                                   wt_material **material, wt_error *err) WT_NODISCARD;
/* Creates a table law: ln E' and ln E'' are linear in ln w between n >= 2 increasing knots; all
 * values > 0. For extrapolation with slopes, those at the low end must exceed -0.25, as sliding
 * always includes frequency 0. No slope may exceed 100 in magnitude. */
WT_API wt_status wt_material_table(const double *omega, const double *storage, const double *loss,
                                   size_t n, double poisson_ratio, wt_extrapolation extrapolation,
                                   wt_material **material, wt_error *err) WT_NODISCARD;
/* Creates a fractional Zener model: E(w) = (E0 + Eg z) / (1 + z), z = (i w tau)^alpha. Moduli [Pa],
 * tau [s]. */
WT_API wt_status wt_material_fractional_zener(double e0, double eg, double tau, double alpha,
                                              double poisson_ratio, wt_material **material,
                                              wt_error *err) WT_NODISCARD;

/* Transversely isotropic solid with the surface normal as axis: factors on E' and E'' of three
 * moduli, and two real Poisson ratios. */
typedef struct wt_transverse {
    double axial_storage, axial_loss; /* Ez */
    double plane_storage, plane_loss; /* Ep */
    double shear_storage, shear_loss; /* E of the shear modulus Gzp = E / (2 (1 + nu_p)) */
    double
        plane_poisson; /* nu_p: in-plane contraction under an in-plane load; NaN = poisson_ratio */
    double axial_poisson; /* nu_zp: in-plane contraction under an axial load; NaN = poisson_ratio */
} wt_transverse;
WT_API wt_transverse wt_transverse_defaults(void); /* Returns the isotropic case. */
WT_API const wt_params *wt_transverse_params(void);
/* Creates the isotropic solid of this Poisson ratio with the same surface compliance. `axial` and
 * `shear` may be NULL or `plane`: then the law of `plane` is used. Takes ownership of the laws,
 * also on failure. With one law, all factors 1 and equal Poisson ratios the result is `plane`
 * itself. Surface compliance: Conway, Farnham and Ku, J. Appl. Mech. 34 (1967) 491.
 * wt_material_law.check detects unstable or singular cases, which depend on the frequency. */
WT_API wt_status wt_material_transverse(wt_material *plane, wt_material *axial, wt_material *shear,
                                        const wt_transverse *transverse, double poisson_ratio,
                                        wt_material **material, wt_error *err) WT_NODISCARD;
WT_API void wt_material_free(wt_material *material);

/* ---- master curve: one spectrum behind all isotherms ---------------------------------------- */

typedef enum wt_vertical_shift {
    WT_VERTICAL_NONE,
    WT_VERTICAL_PHYSICAL, /* b = rho0 T0 / (rho T) */
    WT_VERTICAL_FREE,
    WT_VERTICAL_TIED /* physical, within clamping scatter and a smooth dependence on temperature,
                        whose size is averaged over */
} wt_vertical_shift;
#define WT_VERTICAL_SHIFT_LIST(X)                                                                  \
    X(WT_VERTICAL_NONE, "none")                                                                    \
    X(WT_VERTICAL_PHYSICAL, "physical")                                                            \
    X(WT_VERTICAL_FREE, "free")                                                                    \
    X(WT_VERTICAL_TIED, "tied")

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
    double reference_temperature;    /* [K], not necessarily that of an isotherm; NaN (default): the
                                        middle isotherm */
    wt_vertical_shift vertical;      /* default TIED */
    double expansion;                /* volumetric thermal expansion in rho T [1/K], default 0 */
    double sample_temperature_error; /* standard error of the temperature of the sample against the
                                        stated one, the same for all isotherms [K], default 0.5;
                                        the draws contain it */
    double terms_per_decade; /* terms of the spectrum per decade; NaN (default): 3, or 10 for sharp
                                lines */
    bool liquid;             /* equilibrium modulus 0 */
    bool series_only;        /* skips the fitted moduli at the points (NaN) and the verdict */
    bool skip_fitted_moduli; /* skips the fitted moduli at the points (NaN) only */
    wt_shift_quantity shift_by; /* default MODULI */
    wt_reference_choice reference_at;
    bool keep_isotherms; /* also those that seem to have another unit, or an E'' of their own */
} wt_master_options;
WT_API wt_master_options wt_master_options_defaults(void);
WT_API const wt_params *wt_master_options_params(void);

/* Where the horizontal shift of an isotherm comes from. */
typedef enum wt_shift_origin {
    WT_SHIFT_FITTED,
    WT_SHIFT_REFERENCE, /* the isotherm that the others are shifted to */
    WT_SHIFT_GIVEN,     /* by a law or a table */
    WT_SHIFT_BY_HAND
} wt_shift_origin;
#define WT_SHIFT_ORIGIN_LIST(X)                                                                    \
    X(WT_SHIFT_FITTED, "fitted")                                                                   \
    X(WT_SHIFT_REFERENCE, "reference")                                                             \
    X(WT_SHIFT_GIVEN, "given")                                                                     \
    X(WT_SHIFT_BY_HAND, "by hand")

/* Shift of one isotherm: x_r = log10 w + log_a, y_r = log10 M + log_b. b multiplies the measured
 * values. */
typedef struct wt_master_shift {
    double temperature; /* [K] */
    bool
        determined; /* false: log_a and log_b are NaN and the isotherm is not in the master curve */
    wt_shift_origin origin;
    wt_interval log_a, log_b; /* [decade]; log_a is 0 at the reference isotherm */
    double log_b_physical;    /* value of rho T */
    double log_b_material;    /* value at this temperature without clamping scatter */
    wt_interval law;          /* log10 aT of the law at this temperature; NaN without one */
    double overlap;           /* frequency range shared with another isotherm [decade] */
    double noise_factor;      /* noise of this isotherm relative to the others */
    size_t n_outliers;        /* excluded values */
    char note[256];           /* "" or a remark */
} wt_master_shift;

/* Source of the shifts. */
typedef enum wt_shift_route {
    WT_SHIFTS_FROM_SPECTRUM, /* fit of one spectrum to all isotherms */
    WT_SHIFTS_FROM_OVERLAP   /* overlap of the storage moduli of neighbours: one spectrum was not
                              found or does not fit the isotherms. Only the shifts are returned; their
                              errors include the variation over the overlap */
} wt_shift_route;

typedef enum wt_superposition {
    WT_SUPERPOSITION_HOLDS,
    WT_SUPERPOSITION_FAILS,
    WT_SUPERPOSITION_INCONCLUSIVE
} wt_superposition;
#define WT_SUPERPOSITION_LIST(X)                                                                   \
    X(WT_SUPERPOSITION_HOLDS, "holds")                                                             \
    X(WT_SUPERPOSITION_FAILS, "fails")                                                             \
    X(WT_SUPERPOSITION_INCONCLUSIVE, "inconclusive")

typedef struct wt_posterior wt_posterior;

/* Master curve: one relaxation spectrum, shifts and shift law for all isotherms, with the joint
 * errors. */
typedef struct wt_master {
    wt_deformation deformation;
    wt_loading loading;
    double reference_temperature;    /* [K] */
    double strain_low, strain_high;  /* range of the mean strain amplitudes of the isotherms; NaN if
                                        the files state none */
    double sample_temperature_error; /* [K], in the draws alone; NaN: none */
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
    wt_interval *fitted_step;         /* [n] value of the fitted spectrum */
    size_t *isotherm;                 /* [n] index into `shifts` */
    bool *is_outlier;                 /* [n] excluded as an outlier in a modulus */
    double noise_storage, noise_loss; /* relative standard deviation */
    double correlation;               /* correlation of the noise of adjacent points */
    /* Errors of the instrument that all isotherms share; spectrum and shifts are without them. NaN
     * after a step or for one quantity. */
    wt_interval phase_lag; /* [rad] at the highest frequency; it is proportional to the frequency */
    wt_interval inertia; /* share of the storage modulus that inertia takes, where that is largest;
                            it takes as much as the square of the frequency */
    wt_interval frame_compliance; /* [1/Pa] of frame and clamps, the assumed error about 0 */
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
    bool equilibrium_limit;  /* only `high`, the end of its 95 % interval, is known */

    wt_superposition superposition;
    double lack_of_fit_p, misfit_low, misfit_high;           /* misfit: relative, 95 % interval */
    double kramers_kronig_p, loss_factor, loss_factor_error; /* ln of a factor on all E'' */
    double valid_from, valid_to;    /* [K] where superposition holds, if it fails beyond; or NaN */
    bool has_converged;             /* false: a fit stopped at the largest number of steps */
    char superposition_reason[256]; /* reason for the verdict on superposition, and how to decide it
                                     */
    size_t evaluations;             /* number of evaluations of the model at all points */
    double step_tolerance, step_bound; /* largest change by one more step: the tolerance, and its
                                          upper bound [standard errors] */
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

/* ---- reduced series: few terms in place of a spectrum ---------------------------------------- */

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

/* ---- rubber: moduli at one temperature, and their shift to others -----------------------------
 */

/* One joint draw of the uncertain properties of a rubber. */
typedef struct wt_rubber_draw {
    wt_prony prony; /* at the reference temperature */
    wt_shift_law law;
    double *log_b; /* [n_vertical] */
} wt_rubber_draw;

/* Source of the moduli. */
typedef enum wt_rubber_kind {
    WT_RUBBER_SERIES, /* prony */
    WT_RUBBER_TABLE,  /* points of the single isotherm of `sweep`, linear in log-log */
    WT_RUBBER_ZENER   /* fractional Zener model, in tension */
} wt_rubber_kind;

/* Fractional Zener model: E(w) = (E0 + Eg z) / (1 + z), z = (i w tau)^alpha. */
typedef struct wt_zener {
    double e0, eg; /* [Pa] */
    double tau;    /* [s] */
    double alpha;
} wt_zener;

/* A rubber: moduli at one reference temperature, and their dependence on temperature. */
typedef struct wt_rubber {
    wt_rubber_kind kind;
    wt_prony prony; /* E or G as measured, vertical shift applied, at the reference temperature;
                       without terms for other kinds */
    wt_zener zener;
    double poisson_ratio;
    bool is_transverse; /* the moduli are the E that `transverse` multiplies */
    wt_transverse transverse;
    wt_shift_law law;                         /* kind WT_LAW_NONE: only the reference temperature */
    wt_superposition superposition;           /* of the isotherms; holds if it was not tested */
    double c1_error, c2_error, c_correlation; /* of a law without isotherms; 0 = unknown */
    double temperature_min, temperature_max;  /* of the isotherms [K]; NaN = unknown */
    size_t n_vertical; /* points of log_b against temperature; 0 = no vertical shift */
    double *vertical_temperature, *vertical_log_b;
    size_t n_draws; /* draws for the replicates; 0 = uncertainty unknown */
    wt_rubber_draw *draws;
    wt_sweep sweep; /* isotherms and fit options, for wt_rubber_refit */
    wt_master_options fit;
} wt_rubber;
WT_API void wt_rubber_clear(wt_rubber *rubber);
/* Adds the items of a rubber that no job computed to the current stage of the cost: terms of a
 * series, points of a table or constants of a law. */
WT_API void wt_rubber_add_cost(const wt_rubber *rubber, const wt_job *work);

/* Opens a rubber: "fractional-zener:e0=5MPa,eg=2GPa,tau=1us,alpha=0.4", or the path of a table of
 * moduli at one temperature, which is that of the file, else of `read`, else unknown. */
WT_API wt_status wt_rubber_open(const char *text, const wt_read_options *read, double poisson_ratio,
                                const wt_job *work, wt_rubber *rubber, wt_error *err) WT_NODISCARD;
/* Replaces the series by the points of a table "master_curve", without draws, but with the shifts
 * of the rubber. A rubber of zeros but for the Poisson ratio is filled from the table. Points
 * closer than a twentieth of a decade are merged. */
WT_API wt_status wt_rubber_tabulate(wt_rubber *rubber, const wt_table *master_curve,
                                    wt_error *err) WT_NODISCARD;
/* Describes the source of the moduli; "" for an isotropic series. Returns the length as snprintf
 * does. */
WT_API size_t wt_rubber_describe(const wt_rubber *rubber, char *buffer, size_t size);

/* Tables of wt_master_compute, as read from a file; borrowed. */
typedef struct wt_rubber_tables {
    const wt_table *prony;
    const wt_table *shift_factors;                 /* NULL: only the reference temperature */
    const wt_table *material_draws, *series_draws; /* NULL: errors unknown */
} wt_rubber_tables;
WT_API wt_status wt_rubber_from_tables(const wt_rubber_tables *tables, double poisson_ratio,
                                       wt_rubber *rubber, wt_error *err) WT_NODISCARD;
/* Refits the isotherms with another vertical shift, without draws. WT_E_MISSING without isotherms.
 */
WT_API wt_status wt_rubber_refit(const wt_rubber *rubber, wt_vertical_shift vertical,
                                 wt_rubber *refitted, wt_error *err) WT_NODISCARD;

/* Creates the material at a temperature [K] (NaN = reference): relaxation times times a_T, moduli
 * divided by b_T. `statement` (may be NULL) receives a remark: outside of the isotherms, b
 * constant. WT_E_MISSING if more than 1 K away without a shift law; WT_E_RANGE at or below the WLF
 * pole. replicate: its number, or WT_NO_REPLICATE. */
WT_API wt_status wt_rubber_material(const wt_rubber *rubber, double temperature, uint64_t seed,
                                    size_t replicate, wt_material **material, char statement[256],
                                    wt_error *err) WT_NODISCARD;

/* ---- samples and their master curves -------------------------------------------------------- */

/* Names of the samples of isotherms and temperature sweeps, sorted; "" for sweeps without a name.
 */
typedef struct wt_sample_names {
    size_t n;
    char **name;
} wt_sample_names;
WT_API void wt_sample_names_clear(wt_sample_names *samples);
/* Reads the names; the caller clears `samples`. The data read are stored in work->dma, if it is not
 * NULL, for the jobs that fit them. */
WT_API wt_status wt_sample_names_read(const wt_file_set *sets, size_t n_sets, const wt_job *work,
                                      wt_sample_names *samples, wt_error *err) WT_NODISCARD;

typedef struct wt_master_job {
    const wt_file_set *sets;
    size_t n_sets;
    wt_master_options fit;        /* reference_temperature NaN: the middle isotherm */
    double poisson_ratio;         /* of the rubber; default 0.5 */
    const char *const *leave_out; /* "temperature:LOW..HIGH" or "frequency:LOW..HIGH"; one limit may
                                     be missing, or one value replaces both */
    size_t n_leave_out;
    const char *shift_law;   /* "wlf:reference-temperature=T,c1=X,c2=X" or
                                "arrhenius:activation-energy=E", the law of all shifts; or NULL */
    const wt_table *shifts;  /* columns temperature, log_a and optionally log_b of fixed shifts,
                                borrowed; or NULL */
    const char *shifts_file; /* of the shifts, for the message of an error in them; or NULL */
    const char *const *hand_shifts; /* "T=LOG_AT", the shift of an isotherm against that nearest to
                                       the reference temperature */
    size_t n_hand_shifts;
    wt_reduction reduction; /* has its own parameters */
} wt_master_job;
WT_API wt_master_job wt_master_job_defaults(void);
WT_API const wt_params *wt_master_job_params(void);

typedef struct wt_master_tables {
    wt_table *shift_factors, *master_curve, *prony, *material_draws, *series_draws;
    size_t n_isotherms;
    wt_table *prony_reduced, *relaxation_spectrum, *influences;
    wt_master *fit; /* fit of these tables */
} wt_master_tables;
WT_API void wt_master_tables_clear(wt_master_tables *tables);

/* Reads the sweeps and fits the master curve. `rubber` receives the data that friction needs. One
 * isotherm is allowed: no shift, no law. Either output may be NULL. */
WT_API wt_status wt_master_compute(const wt_master_job *job, const wt_job *work,
                                   wt_master_tables *tables, wt_rubber *rubber,
                                   wt_error *err) WT_NODISCARD;

/* ---- temperature sweeps: peaks and glass transition ------------------------------------- */

/* Maximum of a curve of scattered points. The errors are due to the scatter of the points, not to
 * the thermometer. */
typedef struct wt_peak {
    bool found;
    wt_interval at, height; /* NaN if not found */
    size_t n;               /* points used */
    double misfit;          /* root mean square deviation from the curve, relative to the height */
    const char *reason;     /* "" or the reason why it is not found; static */
} wt_peak;
/* Finds the peak; x increasing, y > 0. The curve is a parabola of ln y plus a Gaussian process,
 * down to half the height. A largest point that is one of the outer two on a side is no peak. */
WT_API wt_status wt_peak_find(const double *x, const double *y, size_t n, wt_peak *peak,
                              wt_error *err) WT_NODISCARD;
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
    wt_interval at;     /* NaN if not found */
    size_t n;           /* points used */
    const char *reason; /* "" or the reason why it is not found; static */
} wt_onset;
/* Finds the onset; x increasing, y > 0. The curve is that of wt_peak_find through the points about
 * the fall. */
WT_API wt_status wt_onset_find(const double *x, const double *y, size_t n, wt_onset *onset,
                               wt_error *err) WT_NODISCARD;
/* Interpolates at x = `at` with the curve of wt_peak_find through the neighbouring points. The
 * value is NaN outside of the points.
 */
WT_API wt_status wt_smooth_interpolate(const double *x, const double *y, size_t n, double at,
                                       wt_interval *value, wt_error *err) WT_NODISCARD;

/* Glass transition and moduli at given temperatures, from temperature sweeps or from isotherms
 * split by frequency. */
typedef struct wt_ramp_job {
    const wt_file_set *sets;
    size_t n_sets;
    const double *temperature; /* increasing [K]; owned by the caller */
    size_t n_temperatures;
} wt_ramp_job;
WT_API wt_ramp_job wt_ramp_job_defaults(void);
WT_API const wt_params *wt_ramp_job_params(void);
typedef struct wt_ramp_tables {
    wt_table *ramp, *glass_transition;
    wt_table *moduli_at; /* NULL without temperatures */
} wt_ramp_tables;
WT_API wt_status wt_ramp_compute(const wt_ramp_job *job, const wt_job *work, wt_ramp_tables *tables,
                                 wt_error *err) WT_NODISCARD;

/* ---- strain sweeps (Payne effect) ----------------------------------------------------------- */

/* Result for one strain sweep. Values outside of the measured range are NaN. */
typedef struct wt_payne {
    /* Measured values: means of up to three points with the smallest amplitudes (within a factor of
     * three of the smallest) and of the three largest; amplitudes at which the storage modulus
     * first falls below 0.9 and 0.5 of its start, interpolated in ln strain; the largest loss
     * modulus, and its amplitude unless that is one of the outer two on a side. */
    double storage_start, loss_start, storage_end;
    double strain_tenth, strain_half, loss_max, strain_loss_max;
    const char *loss_note; /* what the loss modulus lacks; "" or static */
} wt_payne;
/* Characterises a strain sweep. strain increasing; strain and moduli > 0. loss NULL: not measured,
 * and its results are NaN. */
WT_API wt_status wt_payne_measure(const double *strain, const double *storage, const double *loss,
                                  size_t n, wt_payne *payne, wt_error *err) WT_NODISCARD;

/* Strain softening from strain sweeps. */
typedef struct wt_payne_job {
    const wt_file_set *sets;
    size_t n_sets;
} wt_payne_job;
WT_API wt_payne_job wt_payne_job_defaults(void);
typedef struct wt_payne_tables {
    wt_table *payne, *payne_sweep;
} wt_payne_tables;
WT_API wt_status wt_payne_compute(const wt_payne_job *job, const wt_job *work,
                                  wt_payne_tables *tables, wt_error *err) WT_NODISCARD;

/* ---- softening with strain ------------------------------------------------------------------ */

/* Strain softening of the moduli (Payne effect; Lorenz, Oh, Nam, Jeon and Persson, J. Chem. Phys.
 * 142 (2015) 194701). E' becomes f E' and E'' becomes g E''. f and g are linear in ln strain
 * between n >= 1 points and constant outside. The strain at a wavenumber is strain_factor times the
 * rms slope of the roughness up to it. In a transversely isotropic rubber the factors apply to the
 * effective surface modulus. */
typedef struct wt_softening {
    size_t n;
    double *strain;  /* [n] amplitude, 1 = 100 %, > 0 and rising */
    double *storage; /* [n] f, from 1e-3 to 1e3 */
    double *loss;    /* [n] g, from 1e-3 to 1e3 */
} wt_softening;

/* Checks a softening table. WT_E_ARG or WT_E_RANGE names the invalid point. */
WT_API wt_status wt_softening_check(const wt_softening *softening, wt_error *err) WT_NODISCARD;

/* Strain softening of the moduli of a rubber. */
typedef struct wt_strain_softening {
    wt_softening table;    /* owns its arrays */
    double *storage_error; /* [n] standard error of f; NULL: unknown */
    double *loss_error;    /* [n] standard error of g; NULL: unknown */
    size_t n_sweeps;       /* number of averaged sweeps; 0: a given table */
    double temperature;    /* mean of their temperatures [K]; NaN: unknown */
} wt_strain_softening;
WT_API void wt_strain_softening_clear(wt_strain_softening *strain_softening);
/* Selection among strain sweeps. */
typedef struct wt_strain_softening_choice {
    double temperature; /* the sweeps nearest to it are used [K]; NaN: all have one temperature */
    const char *sample; /* the sweeps of this sample are used; NULL: all have one sample */
} wt_strain_softening_choice;
WT_API wt_strain_softening_choice wt_strain_softening_choice_defaults(void);
/* Reads strain softening from the table payne_sweep, where f and g are storage_ratio and
 * loss_ratio. For several sweeps it is their mean over the common strains; the error is the
 * standard deviation between sweeps, so that 1.96 of it covers 95 % of further sweeps.
 * WT_E_AMBIGUOUS if they have several temperatures or samples and none is chosen, as they are no
 * repeats. Any table with columns strain, f, g and optionally f_error, g_error is also accepted. */
WT_API wt_status wt_strain_softening_from_table(const wt_table *table,
                                                wt_strain_softening_choice choice,
                                                wt_strain_softening *strain_softening,
                                                wt_error *err) WT_NODISCARD;
/* Reads strain softening from the table payne_sweep of a file, or else from its first table. The
 * file is an input of the work, shown as `name`. */
WT_API wt_status wt_strain_softening_read(const char *path, const char *name,
                                          wt_strain_softening_choice choice, const wt_job *work,
                                          wt_strain_softening *strain_softening,
                                          wt_error *err) WT_NODISCARD;

/* ---- export to finite-element programs ------------------------------------------------------- */

/* Export of the reduced series to finite-element programs, in the keywords of their manuals. */
typedef enum wt_fem_program {
    WT_FEM_ABAQUS,
    WT_FEM_ANSYS,
    WT_FEM_CODE_ASTER,  /* needs a Poisson's ratio below 0.5 */
    WT_FEM_LS_DYNA,     /* the same and a density; at most 18 terms; one temperature */
    WT_FEM_OPENRADIOSS, /* the same, at most 100 terms, and a long-term modulus */
    WT_FEM_TABLE
} wt_fem_program;
/* Units of stress and time: Pa and s, MPa and s, GPa and ms. */
typedef enum wt_fem_units { WT_FEM_M_KG_S, WT_FEM_MM_T_S, WT_FEM_MM_KG_MS } wt_fem_units;
typedef enum wt_fem_temperature { WT_FEM_CELSIUS, WT_FEM_KELVIN } wt_fem_temperature;
typedef enum wt_fem_domain { WT_FEM_TIME, WT_FEM_FREQUENCY } wt_fem_domain;
typedef struct wt_fem_export_options {
    wt_fem_units units;
    wt_fem_temperature temperature;
    wt_fem_domain domain; /* only for Abaqus */
    const char *name;     /* a letter, then letters, digits and '_', at most 32; NULL: RUBBER */
    double density;       /* [kg/m^3], NaN: not written */
    double expansion;     /* coefficient of linear thermal expansion [1/K], NaN: not written */
    double poisson_ratio; /* constant in time; default 0.5: incompressible */
} wt_fem_export_options;
WT_API wt_fem_export_options wt_fem_export_options_defaults(void);
WT_API const wt_params *wt_fem_export_options_params(void);
/* Finds a program by name: "abaqus", "ansys", "code_aster", "ls-dyna",
 * "openradioss", "table". False if there is none. */
WT_API bool wt_fem_program_find(const char *name, size_t length, wt_fem_program *program);
/* Checks that the program supports such a material. */
WT_API wt_status wt_fem_export_check(wt_fem_program program, const wt_fem_export_options *options,
                                     wt_error *err) WT_NODISCARD;
/* Writes the material from tables of wt_master_compute. shift_factors NULL: no law. options NULL =
 * defaults. */
WT_API wt_status wt_fem_export(FILE *out, wt_fem_program program, const wt_table *prony_reduced,
                               const wt_table *shift_factors, const wt_fem_export_options *options,
                               wt_error *err) WT_NODISCARD;

#ifdef __cplusplus
}
#endif
#endif
