/* weartrack - model room: pure forward laws. Tips and contact models; WLF and Arrhenius; materials
 * and roughness as laws behind a small table of functions.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
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
/* Linear elasticity, without friction. The modulus of a sphere, paraboloid or punch deeper than its
 * radius is refused by the fit. The sharp pyramid (b = 0) averages over its faces: G = c tan(theta)
 * delta^2 with c = 2/(pi m), 0.7071 for four sides and 0.7698 for three; solved in three dimensions
 * it is 0.738 and 0.882, so that E is 4 and 15 % too high. */

typedef struct wt_tip {
    wt_tip_shape shape;
    unsigned sides;           /* of the pyramid, >= 3; 0 = blunted cone (m = 1) */
    double half_angle;        /* axis to FACE [rad] */
    double radius;            /* of the cap, the sphere or the punch [m]; 0 only if b is 0 */
    double transition_radius; /* b: where the cap meets the faces [m]; 0 = sharp */
    double sample_thickness;  /* of rubber on a rigid base [m]; 0 = as good as endless (default) */
    bool unbonded;            /* it slides on that base */
    double half_angle_error;  /* standard errors [rad] and [m]; 0 = not stated (default). No law */
    double radius_error;      /* uses them: they are common to all curves of a group */
} wt_tip;

/* b = R cos(theta): the sphere tangent to the faces (default of the field's programs). */
WT_API double wt_tip_tangent_transition(double radius, double half_angle);
/* WT_E_RANGE with what is wrong: not finite, radius <= 0, angle outside (0, 90) degrees, or a
 * transition radius that makes the cap concave: b/R > m cot(theta). */
WT_API wt_status wt_tip_check(const wt_tip *tip, wt_error *err) WT_NODISCARD;
/* "pyramid:half-angle=35deg,radius=20nm[,sides=4][,transition=12nm]", "sphere:radius=5um",
 * "cone:half-angle=20deg[,radius=20nm][,transition=12nm]" (a blunted cone with a radius),
 * "paraboloid:radius=5um", "punch:radius=2um". The transition radius is the tangent one unless
 * given; radius=0nm is a sharp pyramid. Half-angle and radius may state a standard error,
 * "radius=20nm+-15%". WT_E_ARG or WT_E_UNIT for the spelling, else as
 * wt_tip_check. `tip` is unchanged on failure. */
WT_API wt_status wt_tip_parse(const char *text, wt_tip *tip, wt_error *err) WT_NODISCARD;
/* The tip in words with all its numbers, b included; returns the length as snprintf does. `tip`
 * must have passed wt_tip_check. */
WT_API size_t wt_tip_describe(const wt_tip *tip, char *buffer, size_t size);

/* G(delta) [m^2] and dG/ddelta = 2a [m] for delta >= 0 (0 and 0 for delta <= 0). Rico et al.,
 * Phys. Rev. E 72 (2005) 021914, in the cancellation-free form. Relative error below 1e-12. Of a
 * thin sample G is that of the base, too, for Poisson's ratio 0.5 if bonded: 0.4 %, in places 2.5 %
 * from exact up to a contact radius of one thickness. */
WT_API void wt_contact_function(const wt_tip *tip, double delta, double *g, double *slope);

/* G and its slope made ready for millions of calls, once for a tip and shared by all curves and
 * threads: piecewise quintic beyond the switch depth b^2/R, exact formula elsewhere. Relative error
 * below 1e-11 in [delta_min, delta_max]; outside, the direct function. WT_E_RANGE as wt_tip_check,
 * and unless 0 < delta_min < delta_max. */
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
/* NaN at and below the pole Tref - c2. */
WT_API double wt_wlf_log_shift(const wt_wlf *wlf, double temperature);
/* Arrhenius: log10 aT = (Ea / (R ln 10)) (1/T - 1/Tref); Ea in J/mol. */
WT_API double wt_arrhenius_log_shift(double activation_energy, double reference_temperature,
                                     double temperature);

typedef enum wt_law_kind {
    WT_LAW_NONE,
    WT_LAW_WLF,
    WT_LAW_ARRHENIUS,
    WT_LAW_JOINED /* WLF, and Arrhenius below a temperature (the glass) */
} wt_law_kind;

typedef struct wt_shift_law {
    wt_law_kind kind;
    wt_wlf wlf;               /* its reference temperature is that of the law, of every kind */
    double activation_energy; /* [J/mol] */
    double joint;             /* Arrhenius below it [K] */
} wt_shift_law;
/* log10 aT, 0 at the reference temperature. NaN where the law has no value. */
WT_API double wt_shift_law_log_a(const wt_shift_law *law, double temperature);

/* ---- shear stress of the real contact ----------------------------------------------------------
 */

typedef enum wt_shear_kind { WT_SHEAR_CONSTANT, WT_SHEAR_LOG_NORMAL } wt_shear_kind;

/* tau_f(v, T) = tau_f0 exp(-width log10(v / v0)^2), v0 = peak_velocity exp(E/kB (1/Tref - 1/T)):
 * Lorenz, Oh, Nam, Jeon and Persson, J. Chem. Phys. 142 (2015) 194701, from which the defaults are.
 */
typedef struct wt_shear_law {
    wt_shear_kind kind;           /* default constant */
    double peak_velocity;         /* at the reference temperature [m/s]; default 6 mm/s */
    double width;                 /* default 0.1 */
    double activation_energy;     /* [J]; default 0.97 eV */
    double reference_temperature; /* [K]; default 293.15 */
} wt_shear_law;
WT_API wt_shear_law wt_shear_law_defaults(void);
WT_API double wt_shear_peak_velocity(const wt_shear_law *law, double temperature);
/* tau_f over tau_f0 > 0; 1 of a constant one. */
WT_API double wt_shear_factor(const wt_shear_law *law, double velocity, double temperature);

/* ---- materials ------------------------------------------------------------------------------- */

/* A viscoelastic material: E(w) = E' + i E'' of the isotropic solid, E(-w) = conj E(w). The kernel
 * knows only this table. */
typedef struct wt_material wt_material;

typedef struct wt_material_law {
    const char *name; /* "prony", "table", "fractional_zener", "transverse" */
    /* E'(w), E''(w) [Pa] at n angular frequencies > 0 [rad/s]. */
    void (*modulus)(const wt_material *material, const double *omega, size_t n, double *storage,
                    double *loss);
    /* Angular integrals in closed form, for the plain modulus E (without 1/(1-nu^2)):
     *   J1 = int_0^2pi cos(phi) E''(w cos phi) dphi, J2 = int_0^2pi |E(w cos phi)|^2 dphi.
     * NULL: the kernel integrates `modulus` itself. */
    void (*angular)(const wt_material *material, const double *omega, size_t n, double *j1,
                    double *j2);
    /* Angular frequencies where the law is not smooth (knots), rising, borrowed; *n = 0 if none. */
    const double *(*breaks)(const wt_material *material, size_t *n);
    void (*free)(wt_material *material);
    /* WT_E_RANGE unless there can be such a material at frequencies up to `high` [rad/s], which are
     * reached from `low` on. `statement` (may be NULL) gets what must be said of one that can be,
     * or "". NULL: the constructor has checked all. */
    wt_status (*check)(const wt_material *material, double low, double high, char statement[256],
                       wt_error *err);
    /* How many terms `angular` adds up. NULL: few. */
    size_t (*terms)(const wt_material *material);
    /* int_0^2pi E''(w cos phi)^2 dphi, the part of J2 from E'' alone, in closed form. NULL: the
     * kernel integrates `modulus`. */
    void (*angular_loss)(const wt_material *material, const double *omega, size_t n, double *j2);
    /* Below the first of the breaks E' and E'' are powers of the frequency. */
    bool power_below;
} wt_material_law;

struct wt_material {
    const wt_material_law *law;
    double poisson_ratio;                /* [0, 0.5] */
    double frequency_min, frequency_max; /* range backed by data [rad/s]; NaN = unlimited */
    void *data;                          /* of the law */
};

/* Outside a table: hold the end values, or go on with the end slope in log-log. Stated, never
 * silent: the kernel reports the share that comes from outside frequency_min..frequency_max. */
typedef enum wt_extrapolation { WT_EXTRAPOLATE_HOLD, WT_EXTRAPOLATE_SLOPE } wt_extrapolation;

/* Generalised Maxwell model. Copies the series; shear moduli are converted, E = 2 (1 + nu) G.
 * poisson_ratio in [0, 0.5]. */
WT_API wt_status wt_material_prony(const wt_prony *prony, double poisson_ratio,
                                   wt_material **material, wt_error *err) WT_NODISCARD;
/* ln E' and ln E'' linear in ln w between n >= 2 rising knots, all values > 0. Continued with
 * slopes, those at the low end must be above -0.25, for sliding always reaches down to frequency 0,
 * and none beyond 100 up or down. */
WT_API wt_status wt_material_table(const double *omega, const double *storage, const double *loss,
                                   size_t n, double poisson_ratio, wt_extrapolation extrapolation,
                                   wt_material **material, wt_error *err) WT_NODISCARD;
/* Fractional Zener model: E(w) = (E0 + Eg z) / (1 + z), z = (i w tau)^alpha. */
WT_API wt_status wt_material_fractional_zener(double e0, double eg, double tau, double alpha,
                                              double poisson_ratio, wt_material **material,
                                              wt_error *err) WT_NODISCARD;

/* Five moduli of a transversely isotropic solid whose axis is the surface normal: factors on E' and
 * E'' of laws, and two real Poisson ratios. */
typedef struct wt_transverse {
    double axial_storage, axial_loss; /* Ez */
    double plane_storage, plane_loss; /* Ep */
    double shear_storage, shear_loss; /* the E of Gzp = E / (2 (1 + nu_p)) */
    double
        plane_poisson; /* nu_p: contraction in the plane under a load in it; NaN = poisson_ratio */
    double axial_poisson; /* nu_zp: in the plane under a load along the axis; NaN likewise */
} wt_transverse;
WT_API wt_transverse wt_transverse_defaults(void); /* isotropic */
WT_API const wt_params *wt_transverse_params(void);
/* The isotropic solid of this Poisson ratio that its surface feels like. `axial` and `shear` may be
 * NULL or `plane`, the law of which then holds. Takes the laws, also on failure. With one law, all
 * factors 1 and equal Poisson ratios that is `plane` itself. The compliance of the surface: Conway,
 * Farnham and Ku, J. Appl. Mech. 34 (1967) 491. What is unstable or singular shows
 * when frequencies are known: wt_material_law.check. */
WT_API wt_status wt_material_transverse(wt_material *plane, wt_material *axial, wt_material *shear,
                                        const wt_transverse *transverse, double poisson_ratio,
                                        wt_material **material, wt_error *err) WT_NODISCARD;
WT_API void wt_material_free(wt_material *material);

/* How the ratio of two moduli goes with the frequency: |ratio| as omega^exponent from `low` to
 * `high`, constant outside of them. */
typedef struct wt_ratio_slope {
    double exponent;    /* 0: the ratio is one number */
    double reference;   /* where the ratio is what it is said to be [rad/s] */
    double low, high;   /* [rad/s] */
    double temperature; /* at which these frequencies are [K]; NaN: at that of the material */
} wt_ratio_slope;
/* ln |ratio| less that at the reference, and the phase of a causal ratio of minimum phase that has
 * it (Bode 1940, by the relations of Kramers and Kronig): exponent pi/2 far inside of `low` and
 * `high`, 0 far outside. omega > 0. */
WT_API void wt_ratio_slope_at(const wt_ratio_slope *slope, double omega, double *log_ratio,
                              double *phase);

/* ---- roughness ------------------------------------------------------------------------------- */

/* Isotropic 2-D power spectrum C(q) [m^4] on [q0, q1], 0 elsewhere. */
typedef struct wt_roughness wt_roughness;

typedef struct wt_roughness_law {
    const char *name; /* "self_affine", "table" */
    void (*density)(const wt_roughness *roughness, const double *q, size_t n, double *c);
    const double *(*breaks)(const wt_roughness *roughness, size_t *n); /* inside (q0, q1) */
    /* int_q0^q k^m C dk for m = 1 or 3 in closed form; NULL: integrated numerically. */
    double (*moment)(const wt_roughness *roughness, int m, double q);
    void (*free)(wt_roughness *roughness);
    bool powers; /* C is a power of q between the breaks */
} wt_roughness_law;

struct wt_roughness {
    const wt_roughness_law *law;
    double q0, q1; /* [rad/m] */
    void *data;
};

/* C = c0 for q0 <= q <= qr, c0 (q/qr)^(-2(1+H)) for qr < q <= q1; -1 < H <= 3. */
WT_API wt_status wt_roughness_self_affine(double q0, double qr, double q1, double hurst, double c0,
                                          wt_roughness **roughness, wt_error *err) WT_NODISCARD;
/* Log-log linear between n >= 2 rising knots; q0, q1 = first and last knot. */
WT_API wt_status wt_roughness_table(const double *q, const double *c, size_t n,
                                    wt_roughness **roughness, wt_error *err) WT_NODISCARD;
WT_API void wt_roughness_free(wt_roughness *roughness);
WT_API double wt_roughness_rms_height(const wt_roughness *roughness); /* [m] */
WT_API double wt_roughness_rms_slope(const wt_roughness *roughness);  /* 1 */

/* ---- a ball on a rubber -----------------------------------------------------------------------
 */

/* Hertz: a^3 = 3 F R (1 - nu^2) / (4 E), of a rigid ball on a rubber that is thick against it. */
typedef struct wt_ball_contact {
    double contact_radius; /* a [m] */
    double pressure;       /* F / (pi a^2) [Pa], the nominal one */
} wt_ball_contact;
WT_API wt_ball_contact wt_ball_contact_of(double load, double radius, double modulus,
                                          double poisson_ratio);
/* The load at which it has that nominal pressure. */
WT_API double wt_ball_load(double pressure, double radius, double modulus, double poisson_ratio);
/* What a place of a circular track, `aside` of its middle line, takes of a contact that comes by
 * once a turn, as a share of always being under the nominal pressure: along the line that passes
 * it, Hertz's pressure makes (3 a / 8 r) (1 - (aside/a)^2), 0 beside the track; a / 4 r in the
 * mean. */
WT_API double wt_ball_duty(double contact_radius, double track_radius, double aside);

#ifdef __cplusplus
}
#endif
#endif
