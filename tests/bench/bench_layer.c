/* The thickness of a layer at many times; the textbook method is bisection of the plain sums.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>

#include "bench/bench.h"

enum { WAVES = 128, TIMES = 61, BISECTIONS = 60 };

typedef struct layer_case {
    double q[WAVES], power[WAVES], time[TIMES], textbook[TIMES];
    wt_energy_source source;
    wt_layer_parameters parameters;
    wt_layer_point points[TIMES];
} layer_case;

static void layer_weartrack(void *data)
{
    layer_case *c = data;
    wt_error err = WT_ERROR_INIT;
    bench_check(wt_layer_history(&c->source, &c->parameters, c->time, TIMES, c->points, &err),
                &err);
}

/* Damage over its limit: accumulated on the way up from z + k sigma0 v t. */
static double damage(const layer_case *c, double depth, double time)
{
    const wt_layer_parameters *p = &c->parameters;
    const double wear = p->specific_wear_rate * p->pressure * p->velocity;
    double sum = 0;
    for (int i = 0; i < WAVES; i++)
        sum -= c->power[i] * exp(-2 * c->q[i] * depth) * expm1(-2 * c->q[i] * wear * time);
    return sum / (p->critical_energy * p->damage * wear);
}

static void layer_plain(void *data)
{
    layer_case *c = data;
    for (int k = 0; k < TIMES; k++) {
        double low = 0, high = 1 / c->q[0];
        for (int i = 0; i < BISECTIONS; i++) {
            const double middle = 0.5 * (low + high);
            if (damage(c, middle, c->time[k]) > 1)
                low = middle;
            else
                high = middle;
        }
        c->textbook[k] = low;
    }
}

void bench_layer(void)
{
    static layer_case c;
    char words[96];
    for (int i = 0; i < WAVES; i++) {
        c.q[i] = 2e3 * pow(1e3, (double)i / (WAVES - 1));
        c.power[i] = 100 * pow(c.q[i] / c.q[0], 0.3);
    }
    c.source = (wt_energy_source){.n = WAVES, .wavenumber = c.q, .power = c.power};
    c.parameters = wt_layer_defaults();
    c.parameters.critical_energy = 2e10;
    c.parameters.specific_wear_rate = 1e-12;
    c.parameters.pressure = 4e5;
    c.parameters.velocity = 0.3;
    c.parameters.incubation = true;
    for (int k = 0; k < TIMES; k++)
        c.time[k] = pow(10, 6.0 * k / (TIMES - 1));
    const double ours = bench_time(layer_weartrack, &c);
    const double textbook = bench_time(layer_plain, &c);
    double difference = 0, stated = 0;
    for (int k = 0; k < TIMES; k++) {
        const wt_estimate depth = c.points[k].thickness;
        if (!(depth.value > 0))
            continue;
        difference = fmax(difference, fabs(c.textbook[k] / depth.value - 1));
        stated = fmax(stated, depth.numerical_error / depth.value);
    }
    snprintf(words, sizeof words, "textbook %.1e off; stated error %.0e", difference, stated);
    bench_row("layer, 61 times, 128 waves", ours, textbook, 1e-3 * TIMES, "per millisecond", words);
}
