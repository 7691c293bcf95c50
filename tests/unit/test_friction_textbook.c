/* The kernel against the plain textbook method, which only shares the laws. */
#include "assert_near.h"

#include "numeric/friction_scene.h"
#include "study/textbook_methods.c"
#include "weartrack/friction.h"

static void kernel_against_textbook(void **state)
{
    (void)state;
    FILE *in = fopen(WT_SOURCE_DIR "/tests/numeric/friction.txt", "r");
    assert_non_null(in);
    numeric_case *c = malloc(sizeof *c);
    assert_non_null(c);
    size_t n = 0;
    while (case_read(in, c)) {
        if (strncmp(c->name, "normal_", 7) != 0 || case_find(c, false, "gamma"))
            continue;
        wt_material *material = NULL;
        wt_roughness *roughness = NULL;
        wt_friction_workspace *ws = NULL;
        wt_friction_point point;
        const double pressure = case_number(c, false, "pressure", 0);
        const double velocity = case_number(c, false, "velocity", 0);
        assert_int_equal(friction_case_material(c, &material, NULL), WT_OK);
        assert_int_equal(friction_case_roughness(c, &roughness, NULL), WT_OK);
        assert_int_equal(wt_friction_workspace_new(material, roughness, NULL, &ws, NULL), WT_OK);
        assert_int_equal(wt_friction_compute(ws, pressure, &velocity, 1, &point, NULL), WT_OK);
        textbook_friction coarse = {0}, fine = {0};
        assert_int_equal(
            textbook_friction_compute(material, roughness, pressure, velocity, 31, 100, &coarse),
            WT_OK);
        assert_int_equal(
            textbook_friction_compute(material, roughness, pressure, velocity, 4001, 400, &fine),
            WT_OK);
        assert_near(fine.stress_variance, point.stress_variance.value, 1e-3);
        assert_near(fine.hysteresis, point.hysteresis.value, 1e-3);
        /* and it needs more nodes for that */
        assert_true(fabs(coarse.stress_variance / point.stress_variance.value - 1) > 1e-4);
        wt_friction_workspace_free(ws);
        wt_material_free(material);
        wt_roughness_free(roughness);
        n++;
    }
    assert_int_equal(n, 3);
    textbook_friction nothing;
    assert_int_equal(textbook_friction_compute(NULL, NULL, 1, 1, 1, 2, &nothing), WT_E_ARG);
    free(c);
    fclose(in);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(kernel_against_textbook)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
