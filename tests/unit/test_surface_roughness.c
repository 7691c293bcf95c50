/* Power spectra: densities, root-mean-square height and slope, refused values. */
#include "assert_near.h"

#include "numeric/friction_scene.h"

#include <float.h>

static void numeric_cases(void **state)
{
    (void)state;
    FILE *in = fopen(WT_SOURCE_DIR "/tests/numeric/friction.txt", "r");
    assert_non_null(in);
    numeric_case *c = malloc(sizeof *c);
    assert_non_null(c);
    size_t n = 0;
    while (case_read(in, c)) {
        wt_roughness *r = NULL;
        assert_int_equal(friction_case_roughness(c, &r, NULL), WT_OK);
        assert_near(wt_roughness_rms_height(r), case_number(c, true, "rms_height", 0),
                    8 * DBL_EPSILON);
        assert_near(wt_roughness_rms_slope(r), case_number(c, true, "rms_slope", 0),
                    8 * DBL_EPSILON);
        wt_roughness_free(r);
        n++;
    }
    assert_int_equal(n, 19);
    free(c);
    fclose(in);
}

static void densities(void **state)
{
    (void)state;
    wt_roughness *r = NULL, *table = NULL;
    assert_int_equal(wt_roughness_self_affine(500, 2000, 1e6, 0.8, 6e-16, &r, NULL), WT_OK);
    const double q[] = {499, 500, 1500, 2000, 20000, 1e6, 1000001};
    double c[7];
    r->law->density(r, q, 7, c);
    assert_near(c[0], 0, 0);
    assert_near(c[1], 6e-16, 0);
    assert_near(c[2], 6e-16, 0);
    assert_near(c[3], 6e-16, 1e-14);
    assert_near(c[4], 6e-16 * pow(10, -3.6), 1e-14);
    assert_near(c[5], 6e-16 * pow(500, -3.6), 1e-14);
    assert_near(c[6], 0, 0);
    /* the same as a table */
    const double knots[] = {500, 2000, 1e6}, values[] = {6e-16, 6e-16, 6e-16 * pow(500, -3.6)};
    assert_int_equal(wt_roughness_table(knots, values, 3, &table, NULL), WT_OK);
    double same[7];
    table->law->density(table, q, 7, same);
    for (size_t i = 0; i < 7; i++)
        assert_near(same[i], c[i], 1e-13);
    assert_near(wt_roughness_rms_height(table), wt_roughness_rms_height(r), 1e-14);
    wt_roughness_free(table);
    wt_roughness_free(r);
}

/* int q^m C in closed form where the exponent vanishes: C ~ q^-2 gives a logarithm. */
static void logarithmic_moment(void **state)
{
    (void)state;
    wt_roughness *r = NULL;
    assert_int_equal(wt_roughness_self_affine(100, 100, 1e5, 0, 3e-15, &r, NULL), WT_OK);
    assert_near(wt_roughness_rms_height(r), sqrt(2 * M_PI * 3e-15 * 1e4 * log(1e3)), 1e-14);
    wt_roughness_free(r);
}

static void power_of_q(const wt_roughness *roughness, const double *q, size_t n, double *c)
{
    (void)roughness;
    for (size_t i = 0; i < n; i++)
        c[i] = 3e-15 * pow(q[i] / 100, -3.4);
}

static const double *no_breaks(const wt_roughness *roughness, size_t *n)
{
    (void)roughness;
    *n = 0;
    return NULL;
}

/* A law without a moment in closed form is integrated: the same as the closed form. */
static void integrated_moment(void **state)
{
    (void)state;
    static const wt_roughness_law law = {.name = "own", .density = power_of_q, .breaks = no_breaks};
    const wt_roughness own = {.law = &law, .q0 = 100, .q1 = 1e5};
    wt_roughness *r = NULL;
    assert_int_equal(wt_roughness_self_affine(100, 100, 1e5, 0.7, 3e-15, &r, NULL), WT_OK);
    assert_near(wt_roughness_rms_height(&own), wt_roughness_rms_height(r), 1e-12);
    assert_near(wt_roughness_rms_slope(&own), wt_roughness_rms_slope(r), 1e-12);
    wt_roughness_free(r);
}

static void bad_input(void **state)
{
    (void)state;
    const double nan = (double)NAN, infinite = (double)INFINITY;
    const struct {
        double v[5]; /* q0, qr, q1, hurst, c0 */
        const char *word;
    } table[] = {
        {{0, 1, 2, 0.8, 1}, "q0"},        {{nan, 1, 2, 0.8, 1}, "q0"},  {{1, 1, 1, 0.8, 1}, "q1"},
        {{1, 1, infinite, 0.8, 1}, "q1"}, {{1, 0.5, 2, 0.8, 1}, "qr"},  {{1, 2.5, 2, 0.8, 1}, "qr"},
        {{1, 1, 2, -1, 1}, "hurst"},      {{1, 1, 2, nan, 1}, "hurst"}, {{1, 1, 2, 0.8, 0}, "c0"},
        {{1, 1, 2, 0.8, infinite}, "c0"},
    };
    wt_roughness *r = NULL;
    for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
        const double *v = table[i].v;
        wt_error err = WT_ERROR_INIT;
        assert_int_equal(wt_roughness_self_affine(v[0], v[1], v[2], v[3], v[4], &r, &err),
                         WT_E_RANGE);
        assert_non_null(strstr(err.message, table[i].word));
        assert_true(err.expected[0] != '\0');
    }
    wt_error err = WT_ERROR_INIT;
    const double q[] = {1, 2, 2}, c[] = {1, 1, 0};
    assert_int_equal(wt_roughness_table(q, c, 3, &r, &err), WT_E_RANGE);
    assert_non_null(strstr(err.place, "knot 3 of 3"));
    assert_int_equal(wt_roughness_table(q, c + 1, 2, &r, &err), WT_E_RANGE);
    assert_non_null(strstr(err.message, "density"));
    assert_int_equal(wt_roughness_table(q, c, 1, &r, &err), WT_E_ARG);
    assert_null(r);
    wt_roughness_free(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numeric_cases),      cmocka_unit_test(densities),
        cmocka_unit_test(logarithmic_moment), cmocka_unit_test(integrated_moment),
        cmocka_unit_test(bad_input),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
