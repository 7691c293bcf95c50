/* Case and records of a scene.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "growth_sample.h"
#include "sliding_case.h"

#include <math.h>
#include <stdio.h>

enum { SAMPLES = 8, LAPS = 600 };
enum { WITHIN = 16 }; /* points averaged to a sample, as in an instrument */
static const double velocity = 0.3, is_stated_ratio = 0.6;

static const contact stated = {.q0 = 2e3,
                               .qr = 4e3,
                               .q1 = 1e6,
                               .hurst = 0.8,
                               .c0 = 2e-17,
                               .pressure = 0.4e6,
                               .shear_stress = 3e6,
                               .poisson = 0.5,
                               .temperature = 20,
                               .velocities = 1,
                               .velocity = {0.3},
                               .wear_rate = 1e-12,
                               .critical_energy = 2e10};

bool growth_make(const growth_scene *s, random_source *random, growth_made *m)
{
    const rubber lines = rubber_make(RUBBER_LINES);
    const rubber_state state = {.rubber = &lines, .a = {1, 1}, .factor = 1};
    growth_truth expected;
    m->truth = stated;
    m->truth.pressure = random_about(stated.pressure, s->of_inputs, random);
    m->truth.c0 = random_about(stated.c0, s->of_inputs, random);
    m->truth.shear_stress = random_about(stated.shear_stress, s->of_inputs, random);
    m->truth.wear_rate = random_about(stated.wear_rate, s->of_layer, random);
    m->truth.critical_energy = random_about(stated.critical_energy, s->of_layer, random);
    const double ratio = random_about(is_stated_ratio, s->of_ratio, random);
    if (!growth_solve(&stated, &state, is_stated_ratio, s->transport, &expected) ||
        !growth_solve(&m->truth, &state, ratio, s->transport, &m->growth))
        return false;
    m->length = (s->lengths > 0 ? s->lengths : 4) * expected.settled;
    return true;
}

/* Mass lost under this load, as weighed. */
static void write_weighed(const growth_scene *s, const growth_made *m, FILE *out)
{
    static const double load = 5, density = 1150;
    fprintf(out,
            "<record><files>record.csv</files><load>%gN</load><mass-loss>%.4gmg +- %g%%</mass-loss>"
            "<density>%gkg/m^3</density></record>",
            load, 1e6 * density * m->truth.wear_rate * load * velocity * m->length,
            100 * s->weighed, density);
}

bool growth_write_case(const growth_scene *s, const growth_made *m, const char *path)
{
    FILE *out = sliding_case_begin(path, &stated, s->of_inputs);
    if (out == NULL)
        return false;
    fprintf(out, "<sliding><pressure>%gPa +- %g%%</pressure><velocity>%gm/s</velocity>",
            stated.pressure, 100 * s->of_inputs, velocity);
    fprintf(out, "<shear-stress>%gPa +- %g%%</shear-stress>", stated.shear_stress,
            100 * s->of_inputs);
    fprintf(out,
            "</sliding><layer><specific-wear-rate>%gm^2/N +- %g%%</specific-wear-rate>"
            "<critical-energy>%gJ/m^3 +- %g%%</critical-energy><incubation>%s</incubation>"
            "<modulus-ratio>%g +- %g%%</modulus-ratio></layer>",
            stated.wear_rate, 100 * s->of_layer, stated.critical_energy, 100 * s->of_layer,
            s->transport ? "yes" : "no", is_stated_ratio, 100 * s->of_ratio);
    if (s->weighed > 0)
        write_weighed(s, m, out);
    fprintf(out, "</case>\n");
    return ferror(out) == 0 && fclose(out) == 0;
}

static double mean_friction(const growth_scene *s, const growth_made *m, double from, double length)
{
    const double time = s->off_time > 0 ? s->off_time : 1;
    double sum = 0;
    for (int i = 0; i < WITHIN; i++)
        sum += growth_friction(&m->growth, (from + length * (i + 0.5) / WITHIN) / time);
    return sum / WITHIN;
}

bool growth_write_record(const growth_scene *s, const growth_made *m, const char *path,
                         random_source *random)
{
    const int laps = s->laps > 0 ? s->laps : LAPS, samples = s->samples > 0 ? s->samples : SAMPLES;
    const double noise = 0.002, lap = m->length / laps;
    FILE *out = fopen(path, "w");
    if (out == NULL)
        return false;
    /* fixtures/growth was drawn with a slow scatter of size 0 */
    (void)random_normal(random);
    fprintf(out, "time (s),laps,velocity (mm/s),mu\n");
    for (int i = 0; i < laps; i++) {
        (void)random_normal(random);
        const double off = noise * random_normal(random);
        for (int k = 0; k < samples; k++)
            fprintf(out, "%.9g,%.9g,%.9g,%.9g\n", lap * (i + k / (double)samples),
                    i + k / (double)samples, 1e3 * velocity,
                    mean_friction(s, m, lap * (i + k / (double)samples), lap / samples) + off);
    }
    return ferror(out) == 0 && fclose(out) == 0;
}
