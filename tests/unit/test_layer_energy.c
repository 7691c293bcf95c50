/* Energy density against depth, its source in friction, and the stiffness of a layered
 * half-space. */
#include "assert_near.h"

#include "core/math/simd.h"
#include "friction/numerics/persson_contact.h"
#include "layer/numerics/energy_density_kernel.h"
#include "weartrack/layer.h"

#include <float.h>

/* ---- many exponentials at a time --------------------------------------------------------------
 */

/* To the last digits for any number of terms, and 0 far below. */
static void exponentials(void **state)
{
    (void)state;
    enum { N = 999 };
    double x[N], power[N], less_one[N];
    for (size_t i = 0; i < N; i++)
        x[i] = i % 2 == 0 ? -pow(10, -20 + 22.85 * (double)i / N) : 700.0 - 1.4 * (double)i;
    vector_exp(x, N, power);
    vector_expm1(x, N, less_one);
    for (size_t i = 0; i < N; i++) {
        assert_near(power[i], exp(x[i]), 2 * DBL_EPSILON);
        assert_near(less_one[i], expm1(x[i]), 2 * DBL_EPSILON);
    }
    const double far[] = {-(double)INFINITY, -709, -1e300, 0, (double)NAN};
    vector_exp(far, 5, power);
    vector_expm1(far, 5, less_one);
    for (size_t i = 0; i < 3; i++) {
        assert_true(power[i] == 0);
        assert_true(less_one[i] == -1);
    }
    assert_true(power[3] == 1 && less_one[3] == 0 && isnan(power[4]) && isnan(less_one[4]));
}

/* ---- energy density -------------------------------------------------------------------------- */

/* The tail is the integral of the density, and the gain is a difference of tails. */
static void density_tail_gain(void **state)
{
    (void)state;
    wt_energy_source source = {.profile = WT_PROFILE_PERSSON,
                               .n = 3,
                               .wavenumber = (double[]){3e4, 4.1e5, 6e6},
                               .power = (double[]){120, 90, 200}};
    const double frictions[] = {0, 0.385, 1, 2.385, 1e9};
    for (size_t i = 0; i <= 5; i++) {
        if (i > 0) {
            source.profile = WT_PROFILE_INCOMPRESSIBLE;
            source.local_friction = frictions[i - 1];
        }
        assert_near(wt_energy_tail(&source, 0), 410, 1e-14);
        const double low = 3e-7, high = 9e-6;
        const int n = 20000;
        double sum = 0;
        for (int k = 0; k < n; k++)
            sum += wt_energy_density(&source, low + (high - low) * (k + 0.5) / n);
        sum *= (high - low) / n;
        const double difference = wt_energy_tail(&source, low) - wt_energy_tail(&source, high);
        assert_near(sum, difference, 1e-5);
        assert_near(exp(energy_log_integral(&source, low, high - low)), difference, 1e-12);
        assert_near(exp(energy_log_integral(&source, low, 1e-15)) / 1e-15,
                    wt_energy_density(&source, low), 1e-6);
    }
    assert_near(wt_energy_density(&source, -1), 0, 0);
}

/* Total dissipation: int w dz = mu_hys sigma0 v. The thickness depends on the tolerance only within
 * the stated error. */
static void source_of_friction(void **state)
{
    (void)state;
    double modulus[] = {2e6, 8e6, 6e7, 5e8, 4e8}, tau[] = {1e-1, 1e-3, 1e-5, 1e-7, 1e-9};
    const wt_prony prony = {.equilibrium_modulus = 4e6,
                            .n = 5,
                            .relaxation_time = tau,
                            .modulus = modulus,
                            .frequency_min = (double)NAN,
                            .frequency_max = (double)NAN};
    wt_material *material = NULL;
    wt_roughness *roughness = NULL;
    assert_int_equal(wt_material_prony(&prony, 0.49, &material, NULL), WT_OK);
    assert_int_equal(wt_roughness_self_affine(900, 2500, 4e6, 0.8, 4e-16, &roughness, NULL), WT_OK);
    const double pressure = 4e5, velocity = 5e-3;
    double exact = 0;
    for (double tolerance = 1e-12; tolerance < 1e-2; tolerance *= 100) {
        wt_friction_options options = wt_friction_defaults();
        options.tolerance = tolerance;
        wt_friction_workspace *ws = NULL;
        wt_friction_point point;
        wt_energy_source source = {0};
        wt_layer_parameters parameters = wt_layer_defaults();
        wt_layer_steady_state balance;
        assert_int_equal(wt_friction_workspace_new(material, roughness, &options, &ws, NULL),
                         WT_OK);
        assert_int_equal(wt_friction_compute(ws, pressure, &velocity, 1, &point, NULL), WT_OK);
        assert_int_equal(wt_energy_source_from_friction(ws, pressure, velocity, &source, NULL),
                         WT_OK);
        assert_true(source.numerical_error <= tolerance + 1e-13);
        assert_near(wt_energy_tail(&source, 0), point.hysteresis.value * pressure * velocity,
                    point.hysteresis.numerical_error / point.hysteresis.value +
                        source.numerical_error);
        parameters.critical_energy = 2e10;
        parameters.specific_wear_rate = 2e-13;
        parameters.pressure = pressure;
        parameters.velocity = velocity;
        assert_int_equal(wt_layer_steady_state_compute(&source, &parameters, &balance, NULL),
                         WT_OK);
        const wt_estimate thickness = balance.thickness;
        if (exact == 0)
            exact = thickness.value;
        assert_true(exact > 1e-7);
        assert_near_abs(thickness.value, exact, thickness.numerical_error * (1 + 1e-3));
        wt_energy_source_clear(&source);
        wt_friction_workspace_free(ws);
    }
    wt_material_free(material);
    wt_roughness_free(roughness);
}

/* Far below the surface only the longest waves remain: ln w against an integral of j(q) g by short
 * subintervals. P is 1 and the material is elastic except for one slow process, so that q j ~ q^4
 * C. */
static void deep_tail(void **state)
{
    (void)state;
    double modulus[] = {1e6}, tau[] = {1e-12};
    const wt_prony prony = {.equilibrium_modulus = 1e6,
                            .n = 1,
                            .relaxation_time = tau,
                            .modulus = modulus,
                            .frequency_min = (double)NAN,
                            .frequency_max = (double)NAN};
    const double q0 = 900, q1 = 4e4, pressure = 1e12, velocity = 5e-3;
    wt_material *material = NULL;
    wt_roughness *roughness = NULL;
    assert_int_equal(wt_material_prony(&prony, 0.5, &material, NULL), WT_OK);
    assert_int_equal(wt_roughness_self_affine(q0, q1, q1, 0.8, 4e-16, &roughness, NULL), WT_OK);
    for (double tolerance = 1e-12; tolerance < 1e-1; tolerance *= 100) {
        wt_friction_options options = wt_friction_defaults();
        options.tolerance = tolerance;
        wt_friction_workspace *ws = NULL;
        wt_energy_source source = {0};
        assert_int_equal(wt_friction_workspace_new(material, roughness, &options, &ws, NULL),
                         WT_OK);
        assert_int_equal(wt_energy_source_from_friction(ws, pressure, velocity, &source, NULL),
                         WT_OK);
        for (double x = 0.1; x < 700; x *= 1.7) {
            /* int k^4 exp(-2 k z) dk: q^3 C J1 with J1 ~ q, in closed form by its derivatives */
            const double z = x / q0, a = 2 * z;
            double term = 1 / a, sum = 0, at_end = 0;
            for (int k = 0; k <= 4; k++) {
                sum += term * pow(q0, 4 - k);
                at_end += term * pow(q1, 4 - k);
                term *= (4 - k) / a;
            }
            const double power = log(sum - at_end * exp(-a * (q1 - q0))) - a * q0;
            const double whole = log((pow(q1, 5) - pow(q0, 5)) / 5);
            const double tail = energy_log_tail(&source, z) - energy_log_tail(&source, 0);
            assert_near_abs(tail, power - whole,
                            2 * source.numerical_error + 1e-11 + 1e-14 * fabs(power));
        }
        assert_true(source.numerical_error <= tolerance + 1e-12);
        wt_energy_source_clear(&source);
        wt_friction_workspace_free(ws);
    }
    wt_material_free(material);
    wt_roughness_free(roughness);
}

/* ---- a layer on a half-space ----------------------------------------------------------------- */

static void layered_limits(void **state)
{
    (void)state;
    const double ratios[] = {1e-9, 1e-3, 0.385, 1, 2.385, 1e3, 1e9};
    for (size_t i = 0; i < 7; i++) {
        assert_near(layered_scale(0, ratios[i]), 1, 0);
        assert_near(layered_scale(1e200, ratios[i]), ratios[i], 0);
        assert_near(layered_scale(50, ratios[i]), ratios[i], 1e-14);
        double last = 1;
        for (double x = 1e-9; x < 100; x *= 1.3) { /* monotonic from bulk to layer */
            const double scale = layered_scale(x, ratios[i]);
            const double step = (scale - last) * (ratios[i] > 1 ? 1 : -1);
            assert_true(step >= -4 * DBL_EPSILON * scale);
            last = scale;
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(exponentials),       cmocka_unit_test(density_tail_gain),
        cmocka_unit_test(source_of_friction), cmocka_unit_test(deep_tail),
        cmocka_unit_test(layered_limits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
