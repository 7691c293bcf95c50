/* The intervals of a spot over many draws of surface, drift, noise and place.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "spot_scene.h"

enum { DRAWS = 100 };
#define T_13 2.160368656461 /* 97.5 % of Student's t of 13 degrees of freedom */

/* One draw of surface, drift between the pixels, noise and place. */
typedef struct scene {
    double dent, rows, strain, tilt;
    size_t n; /* pixels of the image after, of the same size */
} scene;

static wt_table *draw(const scene *c, uint64_t seed, double shift[2])
{
    surface s = random_surface(&seed);
    wt_spot_job job = job_of(DEPTH);
    s.rows = c->rows;
    job.x = s.x = 0.5e-6 + 100e-9 * (uniform(&seed) - 0.5);
    job.y = s.y = 0.5e-6 + 100e-9 * (uniform(&seed) - 0.5);
    job.after = after;
    write_image(before, &s, &whole, &seed);
    const view v = {c->n, WIDTH, (6 * uniform(&seed) - 3) * STEP, (20 * uniform(&seed) - 10) * STEP,
                    c->strain};
    s.dent = c->dent;
    s.tilt_x += c->tilt;
    write_image(after, &s, &v, &seed);
    shift[0] = v.shift_x + v.strain * s.x;
    shift[1] = v.shift_y + v.strain * s.y;
    return make(&job);
}

static bool holds(const wt_table *t, const char *low, const char *high, double truth)
{
    return cell(t, 0, low) <= truth && cell(t, 0, high) >= truth;
}

/* How many of the draws of a scene hold the truth: depth, volume, drift in x and y; in none the
 * change lies elsewhere. */
static void count_draws(const scene *c, uint64_t first, int held[4], int *yes)
{
    int elsewhere = 0;
    double furthest = 0;
    for (uint64_t i = 0; i < DRAWS; i++) {
        double shift[2];
        wt_table *t = draw(c, first + i, shift);
        *yes += strncmp(wt_table_key(t, "imprint_verdict"), "yes", 3) == 0;
        elsewhere += strstr(wt_table_key(t, "imprint_verdict"), "deepest") != NULL;
        held[0] += holds(t, "imprint_low", "imprint_high", dent_depth(c->dent));
        held[1] += holds(t, "imprint_volume_low", "imprint_volume_high", dent_volume(c->dent));
        const double off[2] = {cell(t, 0, "shift_x") - shift[0], cell(t, 0, "shift_y") - shift[1]};
        held[2] += fabs(off[0]) <= T_13 * cell(t, 0, "shift_x_standard_error");
        held[3] += fabs(off[1]) <= T_13 * cell(t, 0, "shift_y_standard_error");
        furthest = fmax(furthest, hypot(off[0], off[1]) / STEP);
        wt_table_free(t);
    }
    assert_true(furthest < 0.05); /* of a pixel */
    assert_in_range(elsewhere, 0, 0.05 * DRAWS);
}

/* Intervals hold the truth in 92 to 98 % of the draws of all scenes, and no scene stands out. */
static void test_imprint(void **state)
{
    (void)state;
    static const scene scenes[] = {
        {0, 0, 0, 0, N},         {2e-9, 0, 0, 0, N},        {20e-9, 0, 0, 0, N},
        {1e-9, 0.3e-9, 0, 0, N}, {2e-9, 0, 0.01, 0.005, N}, {2e-9, 0.1e-9, 0, 0, 100},
    };
    enum { SCENES = sizeof scenes / sizeof *scenes };
    int all[4] = {0};
    for (size_t k = 0; k < SCENES; k++) {
        int held[4] = {0}, yes = 0;
        count_draws(&scenes[k], 1000 * (k + 1), held, &yes);
        print_message("scene %zu: depth %d, volume %d, drift %d and %d of %d held, yes %d\n", k,
                      held[0], held[1], held[2], held[3], DRAWS, yes);
        for (int i = 0; i < 4; i++) {
            assert_in_range(held[i], 0.88 * DRAWS, DRAWS);
            all[i] += held[i];
        }
        assert_in_range(yes, k == 0 ? 0 : 0.98 * DRAWS, k == 0 ? 0.06 * DRAWS : DRAWS);
    }
    for (int i = 0; i < 4; i++)
        assert_in_range(all[i], 0.92 * SCENES * DRAWS, 0.98 * SCENES * DRAWS);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_imprint)};
    return cmocka_run_group_tests_name("draws of spots", tests, begin, end);
}
