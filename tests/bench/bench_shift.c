/* Shift factors of 20 isotherms, and of 154 with 2,000 points. The textbook method shifts each
 * isotherm onto its neighbour: E' only, linear interpolation of log10 E', a coarse scan, then
 * golden section.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/bench.h"

#include "core/math/root.h"

#include <math.h>

enum { MOST = 154, POINTS = 13, TERMS = 56, SECTIONS = 16 };

typedef struct shift_case {
    wt_sweep sweep;
    int n;
    double truth[MOST];
    double ours[MOST], textbook[MOST];
    /* log10 of frequency and E', set by the textbook method */
    double x[MOST][POINTS], y[MOST][POINTS];
} shift_case;

static void moduli(double omega, double *storage, double *loss)
{
    *storage = 1e6;
    *loss = 0;
    for (int k = 0; k < TERMS; k++) {
        const double decade = 0.25 * k;
        const double z = omega * pow(10, 2 - decade), e = 2.5e5 * pow(10, 0.22 * decade);
        *storage += e * z * z / (1 + z * z);
        *loss += e * z / (1 + z * z);
    }
}

static void make_sweep(shift_case *c)
{
    bench_random random = {77};
    const wt_wlf wlf = {293.15, 8.5, 130};
    for (int i = 0; i < c->n; i++) {
        wt_isotherm *iso = wt_sweep_add(&c->sweep, POINTS, 0);
        iso->temperature = 253.15 + 80.0 * i / c->n;
        c->truth[i] = wt_wlf_log_shift(&wlf, iso->temperature);
        for (int j = 0; j < POINTS; j++) {
            const double omega = 0.1 * pow(10, 3.0 * j / (POINTS - 1));
            double storage = 0, loss = 0;
            moduli(omega * pow(10, c->truth[i]), &storage, &loss);
            iso->angular_frequency[j] = omega;
            iso->storage_modulus[j] = storage * (1 + 0.005 * bench_normal(&random));
            iso->loss_modulus[j] = loss * (1 + 0.01 * bench_normal(&random));
        }
    }
    wt_sweep_sort(&c->sweep);
}

static void shift_weartrack(void *data)
{
    shift_case *c = data;
    wt_error err = WT_ERROR_INIT;
    wt_master_options options = wt_master_options_defaults();
    wt_master master = {0};
    options.reference_temperature = 293.15;
    options.vertical = WT_VERTICAL_NONE;
    bench_check(wt_master_fit(&c->sweep, &options, NULL, &master, &err), &err);
    for (size_t i = 0; i < master.n_shifts && i < (size_t)c->n; i++)
        c->ours[i] = master.shifts[i].log_a.value;
    wt_master_clear(&master);
}

typedef struct shift_pair {
    const double *from_x, *from_y, *to_x, *to_y; /* [POINTS] */
} shift_pair;

/* Returns minus the mean square distance of an isotherm shifted onto its neighbour. */
static double closeness(double shift, void *user)
{
    const shift_pair *p = user;
    double cost = 0;
    int n = 0, k = 0;
    for (int j = 0; j < POINTS; j++) {
        const double x = p->from_x[j] + shift;
        while (k < POINTS - 2 && x > p->to_x[k + 1])
            k++;
        if (x < p->to_x[0] || x > p->to_x[POINTS - 1])
            continue;
        const double slope = (p->to_y[k + 1] - p->to_y[k]) / (p->to_x[k + 1] - p->to_x[k]);
        const double d = p->from_y[j] - p->to_y[k] - slope * (x - p->to_x[k]);
        cost += d * d;
        n++;
    }
    return n < 4 ? -(double)INFINITY : -cost / n;
}

static double pair_shift(shift_case *c, int from, int to)
{
    static const double farthest = 2.1, step = 0.1;
    shift_pair pair = {c->x[from], c->y[from], c->x[to], c->y[to]};
    double best = 0, most = -(double)INFINITY;
    for (double shift = -farthest; shift < farthest; shift += step) {
        const double close = closeness(shift, &pair);
        if (close > most) {
            most = close;
            best = shift;
        }
    }
    return root_maximum(closeness, &pair, best - step, best + step, SECTIONS);
}

static void shift_textbook(void *data)
{
    shift_case *c = data;
    const int reference = c->n / 2;
    for (int i = 0; i < c->n; i++)
        for (int j = 0; j < POINTS; j++) {
            c->x[i][j] = log10(c->sweep.isotherms[i].angular_frequency[j]);
            c->y[i][j] = log10(c->sweep.isotherms[i].storage_modulus[j]);
        }
    c->textbook[reference] = 0;
    for (int i = reference - 1; i >= 0; i--)
        c->textbook[i] = c->textbook[i + 1] + pair_shift(c, i, i + 1);
    for (int i = reference + 1; i < c->n; i++)
        c->textbook[i] = c->textbook[i - 1] + pair_shift(c, i, i - 1);
}

static void compare(int n)
{
    static shift_case c;
    char words[96], what[64];
    c = (shift_case){.n = n};
    make_sweep(&c);
    const double ours = bench_time(shift_weartrack, &c);
    const double textbook = bench_time(shift_textbook, &c);
    double rms = 0, rms_textbook = 0;
    for (int i = 0; i < n; i++) {
        rms += pow(c.ours[i] - c.truth[i], 2) / n;
        rms_textbook += pow(c.textbook[i] - c.truth[i], 2) / n;
    }
    snprintf(words, sizeof words, "rms from the truth %.4f, textbook %.4f decade", sqrt(rms),
             sqrt(rms_textbook));
    snprintf(what, sizeof what, "sweeps shifted (%d isotherms)", n);
    bench_row(what, ours, textbook, 1, "per second", words);
    wt_sweep_clear(&c.sweep);
}

void bench_shift(void)
{
    compare(20);
    compare(MOST);
}
