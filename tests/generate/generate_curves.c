/* Force maps of bulk and wear track: four positions each, a map of four columns and three rows, one
 * row for each piezo rate. The rubber has the spectrum of the DMA; that of the track is multiplied
 * by one factor.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "generate.h"
#include "writers/jpk_writer.h"

#include <math.h>
#include <stdlib.h>

#define SPOTS 4
#define COLUMNS 4
#define RATES 3
#define CURVES (COLUMNS * RATES)
#define APPROACH 400
#define RETRACT 120

#define SPRING_CONSTANT 0.3 /* N/m */
#define SENSITIVITY 60e-9   /* m/V */
#define DEPTH 100e-9        /* depth of the deepest point [m] */
#define FREE 250e-9         /* travel before contact [m] */
#define NOISE 40e-12        /* standard deviation of the force [N] */
#define SPOT_SCATTER 0.04   /* standard deviation of ln E between and within positions */
#define CURVE_SCATTER 0.03

static const double piezo_rate[RATES] = {0.2e-6, 2e-6, 20e-6};

typedef struct buffers {
    double height[CURVES][2][APPROACH], force[CURVES][2][APPROACH];
    jpk_writer_segment segment[CURVES][2];
    jpk_writer_curve curve[CURVES];
} buffers;

static wt_tip case_tip(void)
{
    wt_tip tip = {.shape = WT_TIP_BLUNTED_PYRAMID, .sides = 4};
    tip.half_angle = 20 * 3.14159265358979323846 / 180;
    tip.radius = 20e-9;
    tip.transition_radius = wt_tip_tangent_transition(tip.radius, tip.half_angle);
    return tip;
}

static void fill_curve(buffers *b, size_t i, const truth_press *p, const wt_rubber *rubber,
                       uint64_t *seed)
{
    double force[2 * TRUTH_STEPS + 1], step = p->travel / TRUTH_STEPS; /* [m] */
    double contact = FREE + 15e-9 * truth_normal(seed), offset = 0.2e-9 * truth_normal(seed);
    double tilt = 2e-4 * truth_normal(seed), top = 5e-6, end = contact + p->travel;
    truth_indent(p, rubber, force);
    for (size_t k = 0; k < APPROACH; k++) {
        double z = end * (double)k / (APPROACH - 1);
        b->height[i][0][k] = top - z;
        b->force[i][0][k] = offset + tilt * z + truth_force_after(force, (z - contact) / step) +
                            NOISE * truth_normal(seed);
    }
    for (size_t k = 0; k < RETRACT; k++) {
        double back = end * (double)k / (RETRACT - 1), z = end - back;
        b->height[i][1][k] = top - z;
        b->force[i][1][k] = offset + tilt * z +
                            truth_force_after(force, TRUTH_STEPS + back / step) +
                            NOISE * truth_normal(seed);
    }
    double duration = end / p->rate;
    b->segment[i][0] =
        (jpk_writer_segment){"extend", APPROACH, duration, b->height[i][0], b->force[i][0], NULL};
    b->segment[i][1] =
        (jpk_writer_segment){"retract", RETRACT, duration, b->height[i][1], b->force[i][1], NULL};
    b->curve[i] = (jpk_writer_curve){i, 5e-6 * (double)(i % COLUMNS), 5e-6 * (double)(i / COLUMNS),
                                     2, b->segment[i]};
}

static int write_spot(buffers *b, const char *path)
{
    jpk_writer_file file = jpk_writer_defaults();
    file.path = path;
    file.map = true;
    file.n_curves = CURVES;
    file.curves = b->curve;
    file.columns = COLUMNS;
    file.rows = RATES;
    file.spring_constant = SPRING_CONSTANT;
    file.sensitivity = SENSITIVITY;
    file.encoding = JPK_WRITE_INT16;
    file.stored = true;
    return jpk_write(&file);
}

int generate_curves(const wt_rubber *rubber, const char *folder, uint64_t variant, double ratio)
{
    static const char *const zone[2] = {"bulk", "track"};
    int result = -1;
    uint64_t seed = 65 + (variant << 32); /* with 64 the ratio depends on the rate by chance */
    wt_tip tip = case_tip();
    wt_material *material = NULL;
    buffers *b = calloc(1, sizeof *b);
    if (b == NULL ||
        wt_rubber_material(rubber, TRUTH_TEMPERATURE, 0, SIZE_MAX, &material, NULL, NULL) != WT_OK)
        goto done;
    for (int g = 0; g < 2; g++) {
        for (int spot = 0; spot < SPOTS; spot++) {
            char name[64];
            double of_spot = SPOT_SCATTER * truth_normal(&seed);
            for (size_t i = 0; i < CURVES; i++) {
                double rate = piezo_rate[i / COLUMNS];
                double factor =
                    (g == 1 ? ratio : 1) * exp(of_spot + CURVE_SCATTER * truth_normal(&seed));
                truth_press press = {.tip = &tip,
                                     .spring_constant = SPRING_CONSTANT,
                                     .rate = rate,
                                     .factor = factor,
                                     .temperature = TRUTH_TEMPERATURE};
                press.travel = truth_travel(material, &press, DEPTH);
                fill_curve(b, i, &press, rubber, &seed);
            }
            snprintf(name, sizeof name, "%s-%d.jpk-force-map", zone[g], spot + 1);
            char *path = wt_path_join(folder, name);
            int bad = path == NULL || write_spot(b, path) != 0;
            free(path);
            if (bad)
                goto done;
        }
    }
    result = 0;
done:
    wt_material_free(material);
    free(b);
    return result;
}
