/* Contributions to friction by scale: against the friction job, and sums.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "sliding_fixture.h"
#include "table_cells.h"

#include "assert_near.h"

#include <stdlib.h>
#include <string.h>

enum { VELOCITIES = 5 };
static const double velocity[VELOCITIES] = {0.01, 0.03, 0.1, 0.3, 1};
static double shifted[3] = {263.15, 293.15, 333.15}, log_b[3] = {-0.08, 0, 0.05};

/* Shifted in both directions. */
static void set_up(void)
{
    sliding_set_up(velocity, VELOCITIES);
    rubber.law = (wt_shift_law){.kind = WT_LAW_WLF,
                                .wlf = {.c1 = 7.4, .c2 = 121.6, .reference_temperature = 293.15}};
    rubber.temperature_min = 263.15;
    rubber.temperature_max = 333.15;
    rubber.n_vertical = 3;
    rubber.vertical_temperature = shifted;
    rubber.vertical_log_b = log_b;
    work.replicates = 0;
}

/* Friction job at a temperature and a pressure. */
static wt_table *make_friction(double temperature, double pressure)
{
    wt_sliding there = sliding;
    wt_friction_tables tables = {0};
    there.temperature.value = temperature;
    there.pressure.value = pressure;
    assert_int_equal(wt_sliding_friction_compute(&there, NULL, &work, &tables, NULL), WT_OK);
    return tables.friction;
}

/* ---- decades --------------------------------------------------------------------------------- */

static void decades_add_up(void **state)
{
    (void)state;
    static const double edges[] = {2e3, 1e4, 1e5, 1e6, 2e6};
    enum { DECADES = 4 };
    set_up();
    wt_table *table = NULL, *friction = make_friction((double)NAN, 0.4e6);
    assert_int_equal(wt_friction_by_scale_compute(&sliding, &work, &table, NULL), WT_OK);
    assert_int_equal(wt_table_n_rows(table), 3 * DECADES);
    static const size_t shown[] = {0, VELOCITIES / 2, VELOCITIES - 1};
    for (size_t v = 0; v < 3; v++) {
        double sum = 0, share = 0, error = 0;
        for (size_t k = 0; k < DECADES; k++) {
            const size_t row = v * DECADES + k;
            assert_near(number_cell(table, row, "velocity"), velocity[shown[v]], 0);
            assert_near(number_cell(table, row, "from"), edges[k], 1e-14);
            assert_near(number_cell(table, row, "to"), edges[k + 1], 1e-14);
            assert_true(number_cell(table, row, "hysteresis") > 0);
            sum += number_cell(table, row, "hysteresis");
            share += number_cell(table, row, "share");
            error += number_cell(table, row, "hysteresis_numerical_error");
        }
        assert_near(share, 1, 1e-12);
        assert_near_abs(sum, number_cell(friction, shown[v], "hysteresis"),
                        error + number_cell(friction, shown[v], "hysteresis_numerical_error"));
        assert_near_abs(number_cell(table, v * DECADES + DECADES - 1, "area_ratio"),
                        number_cell(friction, shown[v], "area_ratio"), 1e-10);
    }
    const char *strongest = wt_table_key(table, "strongest");
    assert_non_null(strstr(strongest, "at 100 mm/s: "));
    wt_table_free(table);
    wt_table_free(friction);
}

/* If the roughness ends at the last decade, shearing and the total are those of the contact. */
static void decades_have_the_shearing(void **state)
{
    (void)state;
    set_up();
    sliding.shear_stress.value = 5e6;
    wt_table *table = NULL, *friction = make_friction((double)NAN, 0.4e6);
    assert_int_equal(wt_friction_by_scale_compute(&sliding, &work, &table, NULL), WT_OK);
    const size_t last = wt_table_n_rows(table) - 1;
    const double area = number_cell(table, last, "area_ratio"), pressure = sliding.pressure.value;
    assert_near(number_cell(table, last, "shearing"), 5e6 * area / pressure, 1e-12);
    assert_near_abs(number_cell(table, last, "friction"),
                    number_cell(friction, VELOCITIES - 1, "hysteresis") + 5e6 * area / pressure,
                    1e-9);
    wt_table_free(table);
    wt_table_free(friction);
}

/* A spectrum that ends at whole decades has no empty ones there. */
static void decades_end_at_decades(void **state)
{
    (void)state;
    wt_table *table = NULL;
    set_up();
    surface.q0 = surface.qr = 1e3;
    surface.q1 = 1e6;
    sliding.n_velocity = 1;
    assert_int_equal(wt_friction_by_scale_compute(&sliding, &work, &table, NULL), WT_OK);
    assert_int_equal(wt_table_n_rows(table), 3);
    wt_table_free(table);
    table = NULL;
    surface.q1 = 3e3;
    assert_int_equal(wt_friction_by_scale_compute(&sliding, &work, &table, NULL), WT_OK);
    assert_int_equal(wt_table_n_rows(table), 1);
    assert_near(number_cell(table, 0, "share"), 1, 1e-14);
    wt_table_free(table);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(decades_add_up),
        cmocka_unit_test(decades_have_the_shearing),
        cmocka_unit_test(decades_end_at_decades),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
