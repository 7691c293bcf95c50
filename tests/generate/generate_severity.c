/* Four compounds after mild and after severe sliding: force curves of bulk and tracks as text, a
 * case file for each compound and severity, and the true values:
 *   generate_severity FOLDER [VARIANT]
 * The track is softer by a factor that depends on the rate; variants differ in the measurement
 * errors.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "generate.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { COMPOUNDS = 4, ZONES = 3, SPOTS = 4, RATES = 3, TERMS = 11, APPROACH = 72, RETRACT = 8 };

/* Carbon black (C) and silica (S) at high and low content: stiffness of the rubber, and rise of the
 * modulus by the filler. */
static const struct {
    const char *name, *file;
    double plateau, transition;
} compounds[COMPOUNDS] = {{"HC", "hc", 1.6e6, 3.4e7},
                          {"LC", "lc", 0.8e6, 1.6e7},
                          {"HS", "hs", 1.3e6, 2.2e7},
                          {"LS", "ls", 0.7e6, 1.1e7}};

/* The first zone is the bulk, which both severities share. */
static const struct {
    const char *name;
    /* ratio of track and bulk at the middle rate; pressure of sliding [MPa] */
    double ratio, pressure;
} zones[ZONES] = {{"bulk", 1, 0}, {"mild", 0.80, 0.2}, {"severe", 0.55, 0.8}};

static const double piezo_rate[RATES] = {0.2e-6, 2e-6, 20e-6}; /* [m/s] */
/* change of the ratio with the rate */
static const double per_decade = 0.90;

static const double spring_constant = 0.3; /* [N/m] */
static const double tip_radius = 20e-9, half_angle = 20;
static const double depth = 100e-9, free_travel = 140e-9; /* [m] */
static const double noise = 40e-12;                       /* standard deviation of the force [N] */
/* Standard deviations of ln E between and within positions. */
static const double spot_scatter = 0.03, curve_scatter = 0.02;

typedef struct compound_rubber {
    double time[TERMS], modulus[TERMS];
    wt_rubber of;
} compound_rubber;

static void set_rubber(int compound, compound_rubber *r)
{
    for (int k = 0; k < TERMS; k++) {
        r->time[k] = pow(10, k - 8);
        r->modulus[k] =
            compounds[compound].transition * pow(10, -0.7 * k) + 0.04 * compounds[compound].plateau;
    }
    r->of = (wt_rubber){.prony = {.deformation = WT_SHEAR,
                                  .reference_temperature = TRUTH_REFERENCE,
                                  .equilibrium_modulus = compounds[compound].plateau,
                                  .n = TERMS,
                                  .relaxation_time = r->time,
                                  .modulus = r->modulus,
                                  .frequency_min = (double)NAN,
                                  .frequency_max = (double)NAN},
                        .poisson_ratio = 0.5,
                        .law = {.kind = WT_LAW_WLF, .wlf = {TRUTH_REFERENCE, TRUTH_C1, TRUTH_C2}},
                        .temperature_min = (double)NAN,
                        .temperature_max = (double)NAN};
}

static double rate_ratio(int zone, int rate)
{
    return zone == 0 ? 1 : zones[zone].ratio * pow(per_decade, rate - 1);
}

static FILE *create_file(const char *folder, const char *name)
{
    char *path = wt_path_join(folder, name);
    FILE *out = path == NULL ? NULL : fopen(path, "w");
    if (out == NULL)
        perror(name);
    free(path);
    return out;
}

static int close_file(FILE *out)
{
    const int bad = ferror(out);
    return fclose(out) != 0 || bad ? -1 : 0;
}

static void write_curve(FILE *out, const truth_press *p, const wt_rubber *rubber, uint64_t *seed)
{
    double force[2 * TRUTH_STEPS + 1];
    const double step = p->travel / TRUTH_STEPS, contact = free_travel + 5e-9 * truth_normal(seed),
                 offset = 0.2e-9 * truth_normal(seed), end = contact + p->travel;
    truth_indent(p, rubber, force);
    for (int i = 0; i < APPROACH + RETRACT; i++) {
        const double done = i < APPROACH ? (double)i / (APPROACH - 1)
                                         : 1 + (double)(i - APPROACH + 1) / RETRACT,
                     z = end * (1 - fabs(1 - done)),
                     steps = done <= 1 ? (z - contact) / step : TRUTH_STEPS + (end - z) / step,
                     f = offset + truth_force_after(force, steps) + noise * truth_normal(seed);
        fprintf(out, "%.5g\t%.1f\t%.3f\n", done * end / p->rate * 1e3, 1000 - z * 1e9, f * 1e9);
    }
}

static int write_spot(const char *folder, int compound, int zone, int spot, const wt_tip *tip,
                      const wt_rubber *rubber, const wt_material *material, uint64_t *seed)
{
    char name[64];
    snprintf(name, sizeof name, "%s-%s-%d.txt", compounds[compound].file, zones[zone].name,
             spot + 1);
    FILE *out = create_file(folder, name);
    const double of_spot = spot_scatter * truth_normal(seed);
    if (out == NULL)
        return -1;
    fprintf(out, "# spring constant: %g N/m\ntime [ms]\theight [nm]\tforce [nN]\n",
            spring_constant);
    for (int i = 0; i < RATES; i++) {
        truth_press press = {.tip = tip,
                             .spring_constant = spring_constant,
                             .rate = piezo_rate[i],
                             .factor = rate_ratio(zone, i) *
                                       exp(of_spot + curve_scatter * truth_normal(seed)),
                             .temperature = TRUTH_REFERENCE};
        press.travel = truth_travel(material, &press, depth);
        fputs(i > 0 ? "\n" : "", out);
        write_curve(out, &press, rubber, seed);
    }
    return close_file(out);
}

static int generate_spots(const char *folder, int compound, const wt_rubber *rubber, uint64_t *seed)
{
    wt_tip tip = {.shape = WT_TIP_BLUNTED_PYRAMID,
                  .sides = 4,
                  .half_angle = half_angle * 3.14159265358979323846 / 180,
                  .radius = tip_radius};
    wt_material *material = NULL;
    int bad =
        wt_rubber_material(rubber, TRUTH_REFERENCE, 0, SIZE_MAX, &material, NULL, NULL) != WT_OK;
    tip.transition_radius = wt_tip_tangent_transition(tip.radius, tip.half_angle);
    for (int zone = 0; zone < ZONES && !bad; zone++)
        for (int spot = 0; spot < SPOTS && !bad; spot++)
            bad = write_spot(folder, compound, zone, spot, &tip, rubber, material, seed) != 0;
    wt_material_free(material);
    return bad ? -1 : 0;
}

static void write_group(FILE *out, const char *group, int compound, const char *zone)
{
    fprintf(out, "    <%s spring-constant=\"%gN/m +- 5%%\">\n", group, spring_constant);
    for (int i = 1; i <= SPOTS; i++)
        fprintf(out, "      <files spot=\"%d\">%s-%s-%d.txt</files>\n", i, compounds[compound].file,
                zone, i);
    fprintf(out, "    </%s>\n", group);
}

static int write_case(const char *folder, int compound, int zone, const compound_rubber *r)
{
    char name[64];
    snprintf(name, sizeof name, "%s-%s.xml", compounds[compound].file, zones[zone].name);
    FILE *out = create_file(folder, name);
    if (out == NULL)
        return -1;
    fprintf(out,
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
            "<!-- One of four compounds after one of two severities of sliding: weartrack collect "
            "compares them. -->\n"
            "<case version=\"1\">\n"
            "  <title>%s, %s sliding</title>\n"
            "  <sample>%s</sample>\n"
            "  <condition>%s</condition>\n\n"
            "  <indentation>\n"
            "    <tip>pyramid:half-angle=%gdeg,radius=20nm</tip>\n"
            "    <temperature>20degC</temperature>\n",
            compounds[compound].name, zones[zone].name, compounds[compound].name, zones[zone].name,
            half_angle);
    write_group(out, "bulk", compound, zones[0].name);
    write_group(out, "track", compound, zones[zone].name);
    fprintf(out,
            "  </indentation>\n\n"
            "  <dma>\n"
            "    <poisson-ratio>0.5</poisson-ratio>\n"
            "    <reference-temperature>20degC</reference-temperature>\n"
            "    <prony deformation=\"shear\">\n"
            "      <equilibrium>%gMPa</equilibrium>\n",
            compounds[compound].plateau * 1e-6);
    for (int k = 0; k < TERMS; k++)
        fprintf(out, "      <term time=\"%gs\" modulus=\"%.6gPa\"/>\n", r->time[k], r->modulus[k]);
    fprintf(out,
            "    </prony>\n"
            "  </dma>\n\n"
            "  <roughness>\n"
            "    <self-affine>\n"
            "      <q0>2e3rad/m</q0>\n"
            "      <qr>4e3rad/m</qr>\n"
            "      <q1>2e6rad/m</q1>\n"
            "      <hurst>0.8</hurst>\n"
            "      <c0>2e-17m^4 +- 5%%</c0>\n"
            "    </self-affine>\n"
            "  </roughness>\n\n"
            "  <sliding>\n"
            "    <pressure>%gMPa</pressure>\n"
            "    <velocity>1e-4:10m/s:log:31</velocity>\n"
            "    <reference-velocity>0.3m/s</reference-velocity>\n"
            "    <shear-stress>2MPa +- 10%%</shear-stress>\n"
            "  </sliding>\n\n"
            "  <compare>\n"
            "    <track-to-bulk/>\n"
            "    <by-rate/>\n"
            "  </compare>\n"
            "</case>\n",
            zones[zone].pressure);
    return close_file(out);
}

static int write_truth(const char *folder)
{
    FILE *out = create_file(folder, "truth.txt");
    if (out == NULL)
        return -1;
    fputs("# Modulus of the track over that of the bulk, of all compounds, at three rates of the "
          "piezo.\n# severity rate [m/s] ratio\n",
          out);
    for (int zone = 1; zone < ZONES; zone++)
        for (int i = 0; i < RATES; i++)
            fprintf(out, "%s %g %.6g\n", zones[zone].name, piezo_rate[i], rate_ratio(zone, i));
    return close_file(out);
}

int main(int argc, char **argv)
{
    if (argc < 2 || argc > 3) {
        fprintf(stderr, "usage: generate_severity FOLDER [VARIANT]\n");
        return 2;
    }
    uint64_t seed = 7 + ((argc > 2 ? strtoull(argv[2], NULL, 10) : 0) << 32);
    int bad = write_truth(argv[1]) != 0;
    for (int compound = 0; compound < COMPOUNDS && !bad; compound++) {
        compound_rubber r;
        set_rubber(compound, &r);
        bad = generate_spots(argv[1], compound, &r.of, &seed) != 0;
        for (int zone = 1; zone < ZONES && !bad; zone++)
            bad = write_case(argv[1], compound, zone, &r) != 0;
    }
    return bad ? EXIT_FAILURE : EXIT_SUCCESS;
}
