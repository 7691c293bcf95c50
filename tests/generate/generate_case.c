/* Writes the data files of the bundled case and their true values:
 *   generate_case FOLDER CASE.xml [VARIANT [RATIO]]
 * CASE.xml states the conditions and the power law of the road.
 * The output is reproducible. Variants differ in the measurement errors; they serve to count how
 * often an interval contains the true value. RATIO is the softening of the track.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "case/run/stage_functions.h"
#include "generate.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Two terms for each decade from 1e-8 s to 1e3 s: the transition, and a slow process on the
 * plateau. Without the slow process horizontal and vertical shifts could not be separated there. */
wt_rubber truth_rubber(double relaxation_time[TRUTH_TERMS], double modulus[TRUTH_TERMS])
{
    for (int k = 0; k < TRUTH_TERMS; k++) {
        double decade = -8 + 0.5 * k;
        relaxation_time[k] = pow(10, decade);
        modulus[k] = 3e7 * pow(10, -0.62 * (decade + 8)) + 3e4 +
                     3e5 * exp(-(decade - 0.5) * (decade - 0.5) / 2);
    }
    return (wt_rubber){
        .prony = {.deformation = WT_SHEAR,
                  .reference_temperature = TRUTH_REFERENCE,
                  .equilibrium_modulus = 1.2e6,
                  .n = TRUTH_TERMS,
                  .relaxation_time = relaxation_time,
                  .modulus = modulus,
                  .frequency_min = (double)NAN,
                  .frequency_max = (double)NAN},
        .poisson_ratio = 0.5,
        .law = {.kind = WT_LAW_WLF, .wlf = {TRUTH_REFERENCE, TRUTH_C1, TRUTH_C2}},
        .temperature_min = (double)NAN,
        .temperature_max = (double)NAN,
    };
}

static double key(const wt_table *table, const char *name)
{
    wt_estimate e = {(double)NAN, (double)NAN, (double)NAN, ""};
    return wt_table_estimate(table, name, &e) ? e.value : (double)NAN;
}

/* Friction and thickness of the true material under the conditions of the case file. */
static int write_truth(const wt_rubber *rubber, const char *folder, const char *case_path,
                       double ratio)
{
    int result = -1;
    wt_case *c = NULL;
    flow_run run = {.rubber = *rubber};
    const wt_surface *surface = &run.surface;
    wt_layer_tables layer = {0};
    wt_friction_tables friction = {0};
    wt_job job = wt_job_defaults();
    wt_error err = WT_ERROR_INIT;
    FILE *out = NULL;
    char *path = wt_path_join(folder, "truth.txt");
    job.replicates = 0;
    wt_status status = wt_case_read(case_path, &c, &err);
    run.c = c;
    run.job = job;
    if (status == WT_OK)
        status = flow_step_roughness(&run, &err);
    if (status == WT_OK && !(surface->self_affine && surface->c0.value == TRUTH_ROAD_C0 &&
                             surface->qr == TRUTH_ROLL_OFF && surface->hurst == TRUTH_HURST))
        status = wt_fail(&err, WT_E_ARG, "the case has another road than the maps");
    if (status != WT_OK)
        goto done;
    wt_sliding sliding = flow_run_sliding(&run);
    status = wt_layer_thickness_compute(&sliding, &c->layer, &job, &layer, &err);
    if (status != WT_OK)
        goto done;
    wt_layer_observation observation = {.thickness = layer.thickness,
                                        .modulus_ratio = {ratio, 0, 0, "1"}};
    status = wt_sliding_friction_compute(&sliding, &observation, &job, &friction, &err);
    out = status != WT_OK || path == NULL ? NULL : fopen(path, "w");
    if (out == NULL)
        goto done;
    fputs("# What the data of this case were made from, and what follows from it without error.\n"
          "# name value (SI units)\n",
          out);
    fprintf(out, "modulus_ratio %.6g\n", ratio);
    fprintf(out, "reference_temperature %.6g\n", TRUTH_REFERENCE);
    fprintf(out, "wlf_c1 %.6g\nwlf_c2 %.6g\n", TRUTH_C1, TRUTH_C2);
    fprintf(out, "road_c0 %.6g\nroad_roll_off %.6g\nroad_hurst %.6g\n", TRUTH_ROAD_C0,
            TRUTH_ROLL_OFF, TRUTH_HURST);
    fprintf(out, "hysteresis %.6g\n", key(friction.friction, "hysteresis_at_reference"));
    fprintf(out, "area_ratio %.6g\n", key(friction.friction, "area_ratio_at_reference"));
    fprintf(out, "friction %.6g\n", key(friction.friction, "friction_at_reference"));
    fprintf(out, "friction_with_layer %.6g\n",
            key(friction.friction, "friction_with_layer_at_reference"));
    fprintf(out, "thickness %.6g\n", layer.thickness.value);
    result = ferror(out) ? -1 : 0;
done:
    if (out != NULL && fclose(out) != 0)
        result = -1;
    if (result != 0)
        fprintf(stderr, "%s: %s: %s; %s\n", err.file, err.place, err.message, err.found);
    wt_table_free(layer.layer);
    wt_table_free(friction.friction);
    wt_case_free(c);
    free(path);
    return result;
}

int main(int argc, char **argv)
{
    double relaxation_time[TRUTH_TERMS], modulus[TRUTH_TERMS];
    if (argc < 3 || argc > 5) {
        fprintf(stderr, "usage: generate_case FOLDER CASE.xml [VARIANT [RATIO]]\n");
        return 2;
    }
    const double ratio = argc > 4 ? strtod(argv[4], NULL) : TRUTH_RATIO;
    uint64_t variant = argc > 3 ? strtoull(argv[3], NULL, 10) : 0;
    wt_rubber rubber = truth_rubber(relaxation_time, modulus);
    /* log b of the isotherms, for a material at another temperature */
    double temperature[13], log_b[13];
    for (int i = 0; i < 13; i++) {
        temperature[i] = 243.15 + 10 * i;
        log_b[i] = log10(truth_vertical(temperature[i]));
    }
    rubber.n_vertical = 13;
    rubber.vertical_temperature = temperature;
    rubber.vertical_log_b = log_b;
    return generate_dma(&rubber, argv[1], variant) != 0 ||
                   generate_curves(&rubber, argv[1], variant, ratio) != 0 ||
                   generate_road(argv[1], variant) != 0 ||
                   write_truth(&rubber, argv[1], argv[2], ratio) != 0
               ? EXIT_FAILURE
               : EXIT_SUCCESS;
}
