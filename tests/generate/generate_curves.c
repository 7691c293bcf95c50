/* Force maps of bulk and wear track: four spots each, a map of four columns and three rows, one row
 * for each piezo rate. SPDX-License-Identifier: GPL-3.0-or-later */
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
#define DEPTH 100e-9        /* of the deepest point [m] */
#define FREE 250e-9         /* travel before contact [m] */
#define NOISE 40e-12        /* of the force [N] */
#define SPOT_SCATTER 0.04   /* standard deviation of ln E between and within spots */
#define CURVE_SCATTER 0.03

static const double piezo_rate[RATES] = {0.2e-6, 2e-6, 20e-6};

typedef struct buffers {
    double height[CURVES][2][APPROACH], force[CURVES][2][APPROACH];
    jpk_writer_segment segment[CURVES][2];
    jpk_writer_curve curve[CURVES];
} buffers;

static wt_tip the_tip(void)
{
    wt_tip tip = {.shape = WT_TIP_BLUNTED_PYRAMID, .sides = 4};
    tip.half_angle = 20 * 3.14159265358979323846 / 180;
    tip.radius = 20e-9;
    tip.transition_radius = wt_tip_tangent_transition(tip.radius, tip.half_angle);
    return tip;
}

static double force_at(const wt_tip *tip, double modulus, double depth, double *exponent)
{
    double g, slope;
    wt_contact_function(tip, depth, &g, &slope);
    if (exponent != NULL)
        *exponent = depth * slope / g;
    return modulus / (1 - 0.25) * g;
}

/* Modulus of the bulk at a piezo rate: |E*| at the equivalent frequency of the loading, which
 * itself depends on the modulus. */
static double bulk_modulus(const wt_material *material, const wt_tip *tip, double rate)
{
    double modulus = 1e7;
    for (int i = 0; i < 60; i++) {
        double exponent, storage, loss;
        double travel = DEPTH + force_at(tip, modulus, DEPTH, &exponent) / SPRING_CONSTANT;
        double omega = wt_equivalent_frequency(travel / rate, exponent);
        material->law->modulus(material, &omega, 1, &storage, &loss);
        modulus = hypot(storage, loss);
    }
    return modulus;
}

/* Indentation at a piezo travel beyond contact: k (travel - depth) = F(depth). */
static double depth_at(const wt_tip *tip, double modulus, double travel)
{
    double low = 0, high = travel;
    for (int i = 0; i < 80; i++) {
        double middle = (low + high) / 2;
        if (SPRING_CONSTANT * (travel - middle) > force_at(tip, modulus, middle, NULL))
            low = middle;
        else
            high = middle;
    }
    return (low + high) / 2;
}

static void fill_curve(buffers *b, size_t i, const wt_tip *tip, double modulus, double rate,
                       uint64_t *seed)
{
    double contact = FREE + 15e-9 * truth_normal(seed), offset = 0.2e-9 * truth_normal(seed);
    double tilt = 2e-4 * truth_normal(seed), top = 5e-6;
    double end = contact + DEPTH + force_at(tip, modulus, DEPTH, NULL) / SPRING_CONSTANT;
    for (size_t k = 0; k < APPROACH; k++) {
        double z = end * (double)k / (APPROACH - 1);
        double depth = z > contact ? depth_at(tip, modulus, z - contact) : 0;
        b->height[i][0][k] = top - z;
        b->force[i][0][k] =
            offset + tilt * z + force_at(tip, modulus, depth, NULL) + NOISE * truth_normal(seed);
    }
    /* the way back: a little less force, and a pull before the tip comes free */
    for (size_t k = 0; k < RETRACT; k++) {
        double z = end * (1 - (double)k / (RETRACT - 1)), beyond = z - contact + 20e-9;
        double depth = z > contact ? depth_at(tip, modulus, z - contact) : 0;
        double pull = beyond > 0 && beyond < 60e-9 ? -0.02 * beyond : 0;
        b->height[i][1][k] = top - z;
        b->force[i][1][k] = offset + tilt * z + 0.92 * force_at(tip, modulus, depth, NULL) + pull +
                            NOISE * truth_normal(seed);
    }
    double duration = end / rate;
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

int generate_curves(const wt_rubber *rubber, const char *folder, uint64_t variant)
{
    static const char *const zone[2] = {"bulk", "track"};
    int result = -1;
    uint64_t seed = 64 + (variant << 32);
    wt_tip tip = the_tip();
    wt_material *material = NULL;
    buffers *b = calloc(1, sizeof *b);
    if (b == NULL ||
        wt_rubber_at(rubber, TRUTH_TEMPERATURE, 0, SIZE_MAX, &material, NULL, NULL) != WT_OK)
        goto done;
    for (int g = 0; g < 2; g++) {
        for (int spot = 0; spot < SPOTS; spot++) {
            char name[64];
            double of_spot = SPOT_SCATTER * truth_normal(&seed);
            for (size_t i = 0; i < CURVES; i++) {
                double rate = piezo_rate[i / COLUMNS];
                double modulus = bulk_modulus(material, &tip, rate) * (g == 1 ? TRUTH_RATIO : 1) *
                                 exp(of_spot + CURVE_SCATTER * truth_normal(&seed));
                fill_curve(b, i, &tip, modulus, rate, &seed);
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
