/* Contact laws of the study against 12 digits.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "afm_physics.h"
#include "check.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static char *read_all(const char *folder, const char *name)
{
    char path[1024];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "r");
    char *text = file != NULL ? calloc(1, 1 << 20) : NULL;
    if (text != NULL)
        check_true(name, fread(text, 1, (1 << 20) - 1, file) > 100);
    if (file != NULL)
        fclose(file);
    return text;
}

/* Number after the next "KEY": before `end`; nan if there is none. */
static double number(const char **at, const char *key, const char *end)
{
    char quoted[64];
    snprintf(quoted, sizeof quoted, "\"%s\":", key);
    const char *found = strstr(*at, quoted);
    if (found == NULL || (end != NULL && found > end))
        return (double)NAN;
    *at = found + strlen(quoted);
    return strtod(*at + strspn(*at, " \n["), NULL);
}

static double number_in(const char *at, const char *key, const char *end)
{
    return number(&at, key, end);
}

static size_t list(const char *at, const char *key, double *to)
{
    size_t n = 0;
    if (isnan(number(&at, key, NULL)))
        return 0;
    at += strspn(at, " \n[");
    for (char *end; n < RELAXATIONS; at = end + strspn(end, ", \n")) {
        to[n] = strtod(at, &end);
        if (end == at)
            break;
        n++;
    }
    return n;
}

static afm_tip read_tip(const char *at, const char *end)
{
    afm_tip tip = {.radius = number_in(at, "R", end),
                   .angle = number_in(at, "deg", end) * M_PI / 180,
                   .b = number_in(at, "b", end),
                   .sides = (unsigned)fmax(0, number_in(at, "n", end))};
    if (isnan(tip.angle))
        tip.b = (double)INFINITY;
    else if (isnan(tip.b))
        tip.b = 0;
    return tip;
}

static void check_jkr(const char *text)
{
    int points = 0;
    for (const char *at = text; (at = strstr(at, "\"id\":")) != NULL;) {
        const char *next = strstr(at + 5, "\"id\":"), *p = at;
        const afm_tip tip = read_tip(at, strstr(at, "Estar"));
        const double k = number_in(at, "lever_N_per_m", next);
        const jkr law = {&tip, number_in(at, "Estar_Pa", next), number_in(at, "w_J_per_m2", next)};
        const char *released = strstr(at, "\"pull_off_lever\"");
        if (released != NULL && (next == NULL || released < next)) {
            const double a = jkr_release(&law, k);
            check_near("pull-off of a lever", jkr_force(&law, a), number_in(released, "F_N", next),
                       1e-7); /* the derivative is zero at the minimum of the base position */
        }
        p = strstr(at, "\"points\"");
        for (double depth; !isnan(depth = number(&p, "delta_m", next)); points++) {
            const double a = number(&p, "a_m", next);
            check_near("adhesive depth", jkr_depth(&law, a) + 1e-8, depth + 1e-8, 1e-10);
            check_near("adhesive force", jkr_force(&law, a), number(&p, "F_N", next), 1e-10);
            const double far = number_in(p, "F_DMT_N", strchr(p, '}'));
            if (!isnan(far) && depth > 0) /* limit of the attraction: 2 pi w R */
                check_near("force of Derjaguin, Muller and Toporov",
                           law.reduced * tip_force(&tip, tip_contact_radius(&tip, depth)) -
                               2 * M_PI * law.work * tip.radius,
                           far, 1e-9);
        }
        at += 5;
    }
    check_true("adhesive points", points > 20);
}

/* Base positions with time: line segments or a squared sine. */
static double motion(const char *at, const char *end, double t)
{
    double times[RELAXATIONS], depths[RELAXATIONS];
    const double most = number_in(at, "delta_max_m", end);
    if (!isnan(most)) {
        const double s = sin(M_PI * t / (2 * number_in(at, "t_max_s", end)));
        return most * s * s;
    }
    const size_t n = list(at, "t_s", times);
    list(at, "delta_m", depths);
    for (size_t i = 1; i < n; i++)
        if (t <= times[i] || i + 1 == n)
            return depths[i - 1] +
                   (depths[i] - depths[i - 1]) * (t - times[i - 1]) / (times[i] - times[i - 1]);
    return 0;
}

static void check_lossy_case(const char *at, const char *next)
{
    enum { STEPS = 2000 };
    static double base[STEPS], force[STEPS];
    const char *p = strstr(at, "\"points\"");
    const afm_tip tip = read_tip(at, strstr(at, "prony"));
    relaxation r = {.rest = number_in(at, "Einf_Pa", next)};
    r.n = list(at, "E_Pa", r.e);
    list(at, "tau_s", r.tau);
    for (double t; !isnan(t = number(&p, "t_s", next));) {
        const double expected = number_in(p, "F_N", next);
        for (int i = 0; i < STEPS; i++)
            base[i] = motion(strstr(at, "\"motion\""), p, t * (i + 1) / STEPS);
        check_true("memory", lossy_forces(&tip, &r, number_in(at, "nu", next), (double)INFINITY,
                                          base, STEPS, t / STEPS, force, NULL) == 0);
        check_near("lossy force", force[STEPS - 1] + 1e-11, expected + 1e-11, 1e-4);
    }
}

static void check_layer_file(char *text)
{
    int rows = 0;
    for (char *line = strtok(text, "\n"); line != NULL; line = strtok(NULL, "\n")) {
        double ratio, x[7];
        char tip[16];
        if (sscanf(line, "%lf %15s %lf %lf %lf %lf %lf %lf %lf", &ratio, tip, x, x + 1, x + 2,
                   x + 3, x + 4, x + 5, x + 6) == 9 &&
            ratio >= 0.3 && ratio <= 3 && x[6] < 6) {
            check_near("layer", layer_apparent(ratio, x[6]), x[4], 0.021);
            rows++;
        }
    }
    check_true("rows of layers", rows > 30);
}

/* Contact by the integral equation against published solutions with 11 digits. */
static void check_layers(const char *folder)
{
    char *text = read_all(folder, "layer.csv");
    int rows = 0;
    for (char *line = text != NULL ? strtok(text, "\n") : NULL; line != NULL;
         line = strtok(NULL, "\n")) {
        double ratio, x[7];
        char name[16];
        if (sscanf(line, "%lf %15s %lf %lf %lf %lf %lf %lf %lf", &ratio, name, x, x + 1, x + 2,
                   x + 3, x + 4, x + 5, x + 6) != 9 ||
            !(x[0] > 0.2 && x[0] <= 3))
            continue;
        afm_tip tip = {.radius = 1, .angle = 1, .b = (double)INFINITY};
        if (strcmp(name, "sphere") != 0)
            tip = strcmp(name, "cone") == 0 ? afm_pyramid(0, 45, 0) : afm_pyramid(0.2, 35, 4);
        thin_sample *layer = layer_make(&tip, 1, ratio, 3.1);
        tip.thin = layer;
        check_near("depth on a layer", layer != NULL ? tip_depth(&tip, x[0]) : 0, x[1], 2e-3);
        check_near("force on a layer", layer != NULL ? tip_force(&tip, x[0]) : 0, x[2], 3e-3);
        free(layer);
        rows++;
    }
    check_true("rows of layers by the equation", text == NULL || rows > 40);
    free(text);
}

void check_afm(const char *folder)
{
    char *adhesive = read_all(folder, "jkr.json"), *lossy = read_all(folder, "viscoelastic.json");
    char *layer = read_all(folder, "layer.csv");
    double found;
    const relaxation r = relaxation_cole_cole(0.6, 0.3, 0), p = relaxation_power(0.25, 0.3),
                     beyond = relaxation_cole_cole(0.6, 0.3, 1);
    relaxation_modulus(&r, 1, &found);
    check_near("tan delta", found, 0.3, 1e-6);
    relaxation_modulus(&p, 1, &found);
    check_near("tan delta of powers", found, 0.3, 1e-6);
    relaxation_modulus(&beyond, 1, &found);
    check_near("tan delta beyond the peak", found, 0.3, 1e-6);
    if (adhesive != NULL)
        check_jkr(adhesive);
    for (const char *at = lossy; at != NULL && (at = strstr(at, "\"id\":")) != NULL; at += 5)
        check_lossy_case(at, strstr(at + 5, "\"id\":"));
    if (layer != NULL)
        check_layer_file(layer);
    check_layers(folder);
    free(adhesive);
    free(lossy);
    free(layer);
}

/* Another solution of the same integral equation, accurate to 1e-4. */
void check_thin(const char *folder)
{
    char path[1024], line[256];
    int rows = 0;
    snprintf(path, sizeof path, "%s/thin_sample.txt", folder);
    FILE *file = fopen(path, "r");
    check_true("thin_sample.txt", file != NULL);
    while (file != NULL && fgets(line, sizeof line, file) != NULL) {
        char base, name[16];
        unsigned sides;
        double radius, depth, force;
        if (sscanf(line, "%c %15s %u %lf %lf %lf", &base, name, &sides, &radius, &depth, &force) !=
                6 ||
            strcmp(name, "punch") == 0)
            continue;
        afm_tip tip = afm_pyramid(radius, 35, strcmp(name, "cone") == 0 ? 0 : sides);
        if (strcmp(name, "sphere") == 0 || strcmp(name, "paraboloid") == 0)
            tip = (afm_tip){.radius = radius,
                            .angle = 1,
                            .b = (double)INFINITY,
                            .end = name[0] == 's' ? END_SPHERE : END_FACES};
        thin_sample *thin = thin_make(&tip, 1, base == 'u');
        tip.thin = thin;
        const double a = thin != NULL ? tip_contact_radius(&tip, depth) : 0;
        if (a > 0 && a < 1.2) {
            check_near("thin sample", tip_force(&tip, a), force, 2e-3);
            rows++;
        }
        free(thin);
    }
    if (file != NULL)
        fclose(file);
    check_true("rows of thin samples", rows > 60);
}
