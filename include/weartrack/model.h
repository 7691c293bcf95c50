/* weartrack - model: forward laws of tips and contact, shift factors, materials and roughness.
 * Materials and roughness are accessed through a small table of functions.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WEARTRACK_MODEL_H
#define WEARTRACK_MODEL_H

#include "weartrack/data.h"

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
    unsigned sides;           /* sides of the pyramid, >= 3; 0 = blunted cone (m = 1) */
    double half_angle;        /* axis to FACE [rad] */
    double radius;            /* radius of cap, sphere or punch [m]; 0 only if b is 0 */
    double transition_radius; /* radius b where the cap meets the faces [m]; 0 = sharp */
    double sample_thickness; /* thickness of rubber on a rigid base [m]; 0 (default) = half-space */
    bool unbonded;           /* the rubber slides on that base */
    double half_angle_error; /* standard errors [rad] and [m]; 0 (default) = not stated. The laws do
                                not */
    double radius_error;     /* use them: they are common to all curves of a group */
} wt_tip;

/* Returns b = R cos(theta), for a sphere tangent to the faces (the default of common AFM programs).
 */
WT_API double wt_tip_tangent_transition(double radius, double half_angle);
/* Checks a tip. WT_E_RANGE states the problem: not finite, radius <= 0, angle outside (0, 90)
 * degrees, or a transition radius that makes the cap concave (b/R > m cot(theta)). */
WT_API wt_status wt_tip_check(const wt_tip *tip, wt_error *err) WT_NODISCARD;
/* Parses a tip: "pyramid:half-angle=35deg,radius=20nm[,sides=4][,transition=12nm]",
 * "sphere:radius=5um", "cone:half-angle=20deg[,radius=20nm][,transition=12nm]" (a blunted cone with
 * a radius), "paraboloid:radius=5um", "punch:radius=2um".
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

/* ---- shift laws ------------------------------------------------------------------------------ */

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

typedef struct wt_shift_law {
    wt_law_kind kind;
    wt_wlf wlf;               /* its reference temperature holds for every kind */
    double activation_energy; /* [J/mol] */
    double joint;             /* transition temperature of WT_LAW_WLF_ARRHENIUS [K] */
} wt_shift_law;
/* Returns log10 aT, 0 at the reference temperature. NaN where the law has no value. */
WT_API double wt_shift_law_log_a(const wt_shift_law *law, double temperature);

/* ---- shear stress of the real contact ----------------------------------------------------------
 */

typedef enum wt_shear_kind { WT_SHEAR_CONSTANT, WT_SHEAR_LOG_NORMAL } wt_shear_kind;

/* Shear stress law: tau_f(v, T) = tau_f0 exp(-width log10(v / v0)^2), v0 = peak_velocity exp(E/kB
 * (1/Tref - 1/T)). Law and defaults: Lorenz, Oh, Nam, Jeon and Persson, J. Chem. Phys. 142 (2015)
 * 194701. */
typedef struct wt_shear_law {
    wt_shear_kind kind;           /* default constant */
    double peak_velocity;         /* at the reference temperature [m/s]; default 6 mm/s */
    double width;                 /* default 0.1 */
    double activation_energy;     /* [J]; default 0.97 eV */
    double reference_temperature; /* [K]; default 293.15 */
} wt_shear_law;
WT_API wt_shear_law wt_shear_law_defaults(void);
WT_API double wt_shear_peak_velocity(const wt_shear_law *law, double temperature);
/* Returns tau_f / tau_f0 > 0; 1 for a constant law. */
WT_API double wt_shear_factor(const wt_shear_law *law, double velocity, double temperature);

/* ---- materials ------------------------------------------------------------------------------- */

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

/* Frequency dependence of the ratio of two moduli: |ratio| ~ omega^exponent from `low` to `high`,
 * constant outside. */
typedef struct wt_ratio_slope {
    double exponent;    /* 0: constant ratio */
    double reference;   /* angular frequency of the stated ratio [rad/s] */
    double low, high;   /* [rad/s] */
    double temperature; /* temperature of these frequencies [K]; NaN: that of the material */
} wt_ratio_slope;
/* Computes ln |ratio| relative to the reference, and the phase of the causal minimum-phase ratio
 * with this magnitude (Bode 1940, Kramers-Kronig relations). The phase is exponent pi/2 well inside
 * `low` and `high` and 0 far outside. omega > 0. */
WT_API void wt_ratio_slope_eval(const wt_ratio_slope *slope, double omega, double *log_ratio,
                                double *phase);

/* ---- roughness ------------------------------------------------------------------------------- */

/* Isotropic 2-D power spectrum C(q) [m^4] on [q0, q1], 0 elsewhere. */
typedef struct wt_roughness wt_roughness;

typedef struct wt_roughness_law {
    const char *name; /* "self_affine", "table" */
    void (*density)(const wt_roughness *roughness, const double *q, size_t n, double *c);
    const double *(*breaks)(const wt_roughness *roughness, size_t *n); /* inside (q0, q1) */
    /* Returns int_q0^q k^m C dk for m = 1 or 3 in closed form; NULL: integrated numerically. */
    double (*moment)(const wt_roughness *roughness, int m, double q);
    void (*free)(wt_roughness *roughness);
    bool powers; /* C is a power of q between the breaks */
} wt_roughness_law;

struct wt_roughness {
    const wt_roughness_law *law;
    double q0, q1; /* [rad/m] */
    void *data;
};

/* Creates a self-affine law: C = c0 for q0 <= q <= qr, c0 (q/qr)^(-2(1+H)) for qr < q <= q1; -1 < H
 * <= 3. */
WT_API wt_status wt_roughness_self_affine(double q0, double qr, double q1, double hurst, double c0,
                                          wt_roughness **roughness, wt_error *err) WT_NODISCARD;
/* Creates a table law, log-log linear between n >= 2 increasing knots; q0, q1 = first and last
 * knot. */
WT_API wt_status wt_roughness_table(const double *q, const double *c, size_t n,
                                    wt_roughness **roughness, wt_error *err) WT_NODISCARD;
WT_API void wt_roughness_free(wt_roughness *roughness);
WT_API double wt_roughness_rms_height(const wt_roughness *roughness); /* [m] */
WT_API double wt_roughness_rms_slope(const wt_roughness *roughness);  /* 1 */

/* ---- a ball on a rubber -----------------------------------------------------------------------
 */

/* Hertz contact of a rigid ball on a rubber that is thick compared with a: a^3 = 3 F R (1 - nu^2) /
 * (4 E). */
typedef struct wt_ball_contact {
    double contact_radius; /* a [m] */
    double pressure;       /* nominal pressure F / (pi a^2) [Pa] */
} wt_ball_contact;
WT_API wt_ball_contact wt_ball_contact_compute(double load, double radius, double modulus,
                                               double poisson_ratio);
/* Returns the load [N] for a nominal pressure [Pa]. */
WT_API double wt_ball_load(double pressure, double radius, double modulus, double poisson_ratio);
/* Returns the duty of a point on a circular track at the distance `aside` from the centre line: its
 * load in one turn relative to constant nominal pressure. Along the line through the point, Hertz's
 * pressure gives (3 a / 8 r) (1 - (aside/a)^2), 0 outside of the track; the mean over the track is
 * a / 4 r. */
WT_API double wt_ball_duty(double contact_radius, double track_radius, double aside);

#ifdef __cplusplus
}
#endif
#endif
