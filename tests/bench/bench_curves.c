/* Contact fit of a force curve. The textbook method: Levenberg-Marquardt on E, contact point,
 * offset and tilt with numerical derivatives, the blunted pyramid solved for its contact radius at
 * every point. SPDX-License-Identifier: GPL-3.0-or-later */
#include <gsl/gsl_errno.h>
#include <gsl/gsl_multifit_nlinear.h>
#include <math.h>

#include "bench/bench.h"

enum { N = 2000 };

typedef struct curve {
    double height[N], force[N], time[N], position[N];
    double spring_constant;
    wt_tip tip;
    wt_contact_table *table;
    wt_indent_workspace *workspace;
    wt_indent_fit fit;
    double textbook_modulus;
} curve;

static const double modulus = 4e6, contact = 1.2e-6;

static void make_curve(curve *c)
{
    wt_error err = WT_ERROR_INIT;
    bench_random random = {2385};
    c->spring_constant = 0.5;
    bench_check(wt_tip_parse("pyramid:half-angle=20deg,radius=20nm", &c->tip, &err), &err);
    bench_check(wt_contact_table_new(&c->tip, 1e-12, 1e-5, &c->table, &err), &err);
    c->workspace = wt_indent_workspace_new();
    for (int i = 0; i < N; i++) {
        const double position = 1.5e-6 * i / (N - 1); /* of the tip, rising into the sample */
        double g = 0, slope = 0;
        wt_contact_function(&c->tip, position - contact, &g, &slope);
        const double force = modulus / 0.75 * g;
        c->force[i] = force + 3e-11 + 2e-5 * position + 3e-11 * bench_normal(&random);
        c->height[i] = position + force / c->spring_constant;
        c->time[i] = 1e-3 * i;
        c->position[i] = c->height[i] - c->force[i] / c->spring_constant;
    }
}

static void fit_weartrack(void *data)
{
    curve *c = data;
    wt_error err = WT_ERROR_INIT;
    bench_check(wt_indent_fit_curve(c->table, NULL, c->height, c->force, c->time, N,
                                    c->spring_constant, c->workspace, &c->fit, &err),
                &err);
}

static int residuals(const gsl_vector *p, void *data, gsl_vector *f)
{
    const curve *c = data;
    for (int i = 0; i < N; i++) {
        double g = 0, slope = 0;
        wt_contact_function(&c->tip, c->position[i] - 1e-6 * gsl_vector_get(p, 1), &g, &slope);
        const double model = 1e6 * gsl_vector_get(p, 0) / 0.75 * g + 1e-10 * gsl_vector_get(p, 2) +
                             1e-4 * gsl_vector_get(p, 3) * c->position[i];
        gsl_vector_set(f, (size_t)i, 1e9 * (c->force[i] - model));
    }
    return GSL_SUCCESS;
}

static void fit_textbook(void *data)
{
    curve *c = data;
    gsl_multifit_nlinear_parameters parameters = gsl_multifit_nlinear_default_parameters();
    gsl_multifit_nlinear_workspace *w =
        gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &parameters, N, 4);
    gsl_multifit_nlinear_fdf fdf = {.f = residuals, .n = N, .p = 4, .params = c};
    const double guess[4] = {2, 1e6 * contact - 0.03, 0, 0};
    gsl_vector_const_view start = gsl_vector_const_view_array(guess, 4);
    int info = 0;
    gsl_multifit_nlinear_init(&start.vector, &fdf, w);
    gsl_multifit_nlinear_driver(200, 1e-10, 1e-10, 0, NULL, NULL, &info, w);
    c->textbook_modulus = 1e6 * gsl_vector_get(gsl_multifit_nlinear_position(w), 0);
    gsl_multifit_nlinear_free(w);
}

double bench_curves(void)
{
    static curve c;
    char words[96];
    gsl_set_error_handler_off();
    make_curve(&c);
    const double ours = bench_time(fit_weartrack, &c);
    const double textbook = bench_time(fit_textbook, &c);
    snprintf(words, sizeof words, "%.1e of E, 2000 samples",
             fabs(c.fit.modulus.value / c.textbook_modulus - 1));
    bench_row("force curves fitted", ours, textbook, 1, "per second", words);
    wt_indent_workspace_free(c.workspace);
    wt_contact_table_free(c.table);
    return textbook;
}
