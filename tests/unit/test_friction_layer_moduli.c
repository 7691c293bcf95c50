/* A layer with its own moduli: the phase of a ratio of moduli against the Kramers-Kronig relations,
 * the angular integrals against plain sums, and limits with known friction. */
#include "assert_near.h"

#include "friction/numerics/layered_moduli.h"
#include "weartrack/friction.h"

#include <complex.h>

static const double complex unit = (double complex)I;

/* Temperature of the frequencies: that of the material. */
#define NOT_SAID ((double)NAN)

static double tau[] = {1e-7, 1e-5, 1e-3, 1e-1, 10};
static double modulus[] = {60e6, 25e6, 9e6, 3e6, 1e6};

static wt_material *rubber(double *moduli)
{
    wt_material *made = NULL;
    const wt_prony series = {.deformation = WT_TENSION,
                             .reference_temperature = 293,
                             .equilibrium_modulus = 4e6,
                             .n = 5,
                             .relaxation_time = tau,
                             .modulus = moduli,
                             .frequency_min = (double)NAN,
                             .frequency_max = (double)NAN};
    assert_int_equal(wt_material_prony(&series, 0.5, &made, NULL), WT_OK);
    return made;
}

static wt_roughness *road(void)
{
    wt_roughness *made = NULL;
    assert_int_equal(wt_roughness_self_affine(1e3, 1e4, 1e8, 0.8, 1e-17, &made, NULL), WT_OK);
    return made;
}

static const double velocities[] = {1e-3, 0.1, 10};
enum { N = 3 };

static void find(const wt_material *material, const wt_friction_options *options,
                 wt_friction_point points[N])
{
    wt_roughness *surface = road();
    wt_friction_workspace *ws = NULL;
    wt_error err = WT_ERROR_INIT;
    assert_int_equal(wt_friction_workspace_new(material, surface, options, &ws, &err), WT_OK);
    assert_int_equal(wt_friction_compute(ws, 4e5, velocities, N, points, &err), WT_OK);
    wt_friction_workspace_free(ws);
    wt_roughness_free(surface);
}

static wt_friction_options under(double thickness, double ratio)
{
    wt_friction_options o = wt_friction_defaults();
    o.layer.thickness = thickness;
    o.layer.modulus_ratio = ratio;
    return o;
}

static void assert_alike(const wt_friction_point *a, const wt_friction_point *b, double room)
{
    for (size_t i = 0; i < N; i++) {
        assert_near(a[i].hysteresis.value, b[i].hysteresis.value, room);
        assert_near(a[i].area_ratio.value, b[i].area_ratio.value, room);
    }
}

/* ---- phase ----------------------------------------------------------------------------------- */

/* phase(w) = 2 w / pi PV int (ln|r(w')| - ln|r(w)|) / (w^2 - w'^2) dw' over all frequencies, in u =
 * ln w', by the trapezoidal rule without the pole, where both sides cancel. */
static double kramers_kronig(const wt_ratio_slope *slope, double omega)
{
    const double step = 1e-3, reach = 60;
    double own, other, phase, sum = 0;
    ratio_slope_eval(slope, omega, &own, &phase);
    for (double y = step / 2; y < reach; y += step) {
        for (int side = -1; side <= 1; side += 2) {
            const double at = omega * exp(side * y);
            ratio_slope_eval(slope, at, &other, &phase);
            /* w w' / (w'^2 - w^2) is 1 / (2 sinh(y)), with either sign */
            sum += step * (other - own) / (2 * sinh(side * y));
        }
    }
    return 2 / M_PI * sum;
}

static void phase_is_causal(void **state)
{
    (void)state;
    static const wt_ratio_slope slopes[] = {{0.11, 30, 3, 3e4, NOT_SAID},
                                            {-0.2, 1e5, 1, 1e9, NOT_SAID}};
    for (size_t k = 0; k < 2; k++)
        for (double x = -4; x <= 11; x += 0.73) {
            double log_ratio, phase;
            const double omega = pow(10, x);
            ratio_slope_eval(&slopes[k], omega, &log_ratio, &phase);
            assert_near_abs(phase, kramers_kronig(&slopes[k], omega), 2e-6);
        }
    double log_ratio, phase;
    const wt_ratio_slope wide = {0.1, 1, 1e-30, 1e30, NOT_SAID};
    ratio_slope_eval(&wide, 7, &log_ratio, &phase);
    assert_near(log_ratio, 0.1 * log(7), 1e-15);
    assert_near(phase, 0.1 * M_PI_2, 1e-14);
    ratio_slope_eval(&slopes[0], 1e9, &log_ratio, &phase);
    assert_near(log_ratio, 0.11 * log(3e4 / 30), 1e-15); /* held */
}

/* ---- angular integrals ----------------------------------------------------------------------- */

/* E of the surface at a wavenumber, by the literal formula. */
static double complex felt(const wt_material *bulk, const wt_layer_state *layer, double q,
                           double omega)
{
    double storage, loss, log_ratio, phase;
    bulk->law->modulus(bulk, &omega, 1, &storage, &loss);
    ratio_slope_eval(&layer->slope, omega, &log_ratio, &phase);
    const double complex below = storage + unit * loss;
    const double complex n = 1 / (layer->modulus_ratio * cexp(log_ratio + unit * phase));
    const double complex c = (1 - n) / (1 + n);
    const double x = q * layer->thickness, e = exp(-2 * x);
    return below / n * (1 - 2 * c * (1 + 2 * x * x) * e + c * c * e * e) /
           (1 + 4 * c * x * e - c * c * e * e);
}

static void integrals_are_sums(void **state)
{
    (void)state;
    wt_material *bulk = rubber(modulus);
    static const double waves[] = {2e4, 3e5, 1.3e6, 2e7};
    for (int stiff = 0; stiff < 2; stiff++) {
        const wt_layer_state layer = {.thickness = 1e-6,
                                      .modulus_ratio = stiff ? 2.5 : 0.4,
                                      .slope = {0.08, 1e3, 20, 3e5, NOT_SAID}};
        const layer_moduli m = layer_moduli_create(bulk, layer, 1e-10);
        for (size_t i = 0; i < 4; i++) {
            const double omega = 0.05 * waves[i];
            double j1, j2, loss, error = 0, sum1 = 0, sum2 = 0, sum3 = 0;
            layer_moduli_eval(&m, &waves[i], &omega, 1, &j1, &j2, &loss, &error);
            assert_true(error < 1e-9);
            enum { PARTS = 200000 };
            for (size_t k = 0; k < PARTS; k++) {
                const double cosine = cos(M_PI_2 * ((double)k + 0.5) / PARTS);
                const double complex e = felt(bulk, &layer, waves[i], omega * cosine);
                const double share = 2 * M_PI / PARTS;
                sum1 += share * cosine * cimag(e);
                sum2 += share * pow(cabs(e), 2);
                sum3 += share * pow(cimag(e), 2);
            }
            assert_near(j1, sum1, 1e-8);
            assert_near(j2, sum2, 1e-8);
            assert_near(loss, sum3, 1e-8);
        }
    }
    wt_material_free(bulk);
}

/* ---- limits ---------------------------------------------------------------------------------- */

/* Without thickness: the friction of the bulk, bit by bit. */
static void zero_thickness(void **state)
{
    (void)state;
    wt_material *bulk = rubber(modulus);
    wt_friction_point own[N], none[N];
    const wt_friction_options bare = wt_friction_defaults();
    wt_friction_options o = under(0, 1);
    o.layer.slope = (wt_ratio_slope){0.3, 1e3, 10, 1e5, NOT_SAID};
    find(bulk, &bare, none);
    find(bulk, &o, own);
    assert_alike(own, none, 0);
    wt_material_free(bulk);
}

/* A ratio that hardly depends on the frequency, or only over a short range: the result of a
 * constant ratio. */
static void constant_ratio(void **state)
{
    (void)state;
    wt_material *bulk = rubber(modulus);
    wt_friction_point one[N], own[N];
    wt_friction_options o = under(1e-6, 0.45);
    find(bulk, &o, one);
    o.layer.slope = (wt_ratio_slope){0, 1e3, 10, 1e5, NOT_SAID};
    find(bulk, &o, own);
    assert_alike(own, one, 0);
    o.layer.slope.exponent = 1e-13;
    find(bulk, &o, own);
    assert_alike(own, one, 1e-9);
    o.layer.slope = (wt_ratio_slope){0.3, 1e3, 1e3, 1e3, NOT_SAID};
    find(bulk, &o, own);
    assert_alike(own, one, 1e-9);
    wt_material_free(bulk);
}

/* Frequencies at another temperature follow the shift law. */
static void frequencies_are_shifted(void **state)
{
    (void)state;
    wt_material *bulk = rubber(modulus);
    wt_friction_point warm[N], cold[N];
    wt_friction_options o = under(1e-6, 0.45);
    o.shift = (wt_shift_law){.kind = WT_LAW_WLF, .wlf = {293, 8, 100}};
    o.temperature = 313;
    const double a = pow(10, -8 * 20.0 / 120);
    o.layer.slope = (wt_ratio_slope){0.1, 1e3, 10, 1e5, 293};
    find(bulk, &o, warm);
    o.layer.slope = (wt_ratio_slope){0.1, 1e3 / a, 10 / a, 1e5 / a, NOT_SAID};
    find(bulk, &o, cold);
    assert_alike(warm, cold, 1e-12);
    wt_friction_workspace *ws = NULL;
    wt_roughness *surface = road();
    o.shift.kind = WT_LAW_NONE;
    o.layer.slope.temperature = 293;
    assert_int_equal(wt_friction_workspace_new(bulk, surface, &o, &ws, NULL), WT_E_MISSING);
    wt_roughness_free(surface);
    wt_material_free(bulk);
}

/* Stated errors are correct, tested with a smaller tolerance; share outside the rates. */
static void errors_hold(void **state)
{
    (void)state;
    wt_material *bulk = rubber(modulus);
    wt_friction_point fine[N], rough[N];
    wt_friction_options o = under(1e-6, 0.45);
    o.layer.slope = (wt_ratio_slope){0.1, 1e3, 10, 1e5, NOT_SAID};
    find(bulk, &o, fine);
    o.tolerance = 1e-5;
    find(bulk, &o, rough);
    for (size_t i = 0; i < N; i++) {
        const double off = fabs(rough[i].hysteresis.value - fine[i].hysteresis.value);
        assert_true(off <= rough[i].hysteresis.numerical_error);
        assert_true(fine[i].meets_tolerance);
        assert_true(fine[i].extrapolated_share > 0 && fine[i].extrapolated_share < 1);
    }
    o.layer.slope.low = 1e-3;
    o.layer.slope.high = 1e12;
    find(bulk, &o, rough);
    assert_near_abs(rough[1].extrapolated_share, 0, 0);
    wt_material_free(bulk);
}

/* A softening and flash temperature use the same moduli for a layer with a
 * constant ratio. */
static void with_other_effects(void **state)
{
    (void)state;
    wt_material *bulk = rubber(modulus);
    static double strain[] = {1e-3, 1}, f[] = {1, 0.5}, g[] = {1, 0.8};
    wt_softening softening = {.n = 2, .strain = strain, .storage = f, .loss = g};
    wt_friction_options o = under(1e-6, 0.45);
    o.tolerance = 1e-6;
    o.softening = &softening;
    for (int hot = 0; hot < 2; hot++) {
        wt_friction_point one[N], own[N];
        o.flash.on = hot;
        o.shift = (wt_shift_law){.kind = WT_LAW_WLF, .wlf = {293, 8, 100}};
        if (hot)
            o.softening = NULL;
        o.temperature = 293;
        o.layer.slope = (wt_ratio_slope){0};
        find(bulk, &o, one);
        o.layer.slope = (wt_ratio_slope){1e-13, 1e3, 10, 1e5, NOT_SAID};
        find(bulk, &o, own);
        assert_alike(own, one, 1e-5);
    }
    wt_material_free(bulk);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(phase_is_causal),         cmocka_unit_test(integrals_are_sums),
        cmocka_unit_test(zero_thickness),          cmocka_unit_test(constant_ratio),
        cmocka_unit_test(frequencies_are_shifted), cmocka_unit_test(errors_hold),
        cmocka_unit_test(with_other_effects),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
