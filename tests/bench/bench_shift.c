/* Shift factors of 20 isotherms, and of 154 with 2,000 points. The textbook method: neighbour by
 * neighbour, E' only, best of 2000 trial shifts by linear interpolation.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>

#include "bench/bench.h"

enum { MOST = 154, POINTS = 13, TERMS = 56, TRIALS = 2000 };

typedef struct shift_case {
    wt_sweep sweep;
    int n;
    double truth[MOST];
    double ours[MOST], textbook[MOST];
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

/* log10 E' of an isotherm at log10 omega x by linear interpolation; false outside. */
static bool interpolate(const wt_isotherm *iso, double x, double *y)
{
    for (size_t j = 0; j + 1 < iso->n; j++) {
        const double x0 = log10(iso->angular_frequency[j]);
        const double x1 = log10(iso->angular_frequency[j + 1]);
        if (x < x0 || x > x1)
            continue;
        const double y0 = log10(iso->storage_modulus[j]), y1 = log10(iso->storage_modulus[j + 1]);
        *y = y0 + (y1 - y0) * (x - x0) / (x1 - x0);
        return true;
    }
    return false;
}

static double pair_shift(const wt_isotherm *from, const wt_isotherm *to)
{
    double best = 0, best_cost = (double)INFINITY;
    for (int t = 0; t < TRIALS; t++) {
        const double shift = -2.8 + 5.6 * t / (TRIALS - 1);
        double cost = 0;
        int n = 0;
        for (size_t j = 0; j < from->n; j++) {
            double y = 0;
            if (!interpolate(to, log10(from->angular_frequency[j]) + shift, &y))
                continue;
            const double d = log10(from->storage_modulus[j]) - y;
            cost += d * d;
            n++;
        }
        if (n >= 4 && cost / n < best_cost) {
            best_cost = cost / n;
            best = shift;
        }
    }
    return best;
}

static void shift_textbook(void *data)
{
    shift_case *c = data;
    const int reference = c->n / 2;
    c->textbook[reference] = 0;
    for (int i = reference - 1; i >= 0; i--)
        c->textbook[i] =
            c->textbook[i + 1] + pair_shift(&c->sweep.isotherms[i], &c->sweep.isotherms[i + 1]);
    for (int i = reference + 1; i < c->n; i++)
        c->textbook[i] =
            c->textbook[i - 1] + pair_shift(&c->sweep.isotherms[i], &c->sweep.isotherms[i - 1]);
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
