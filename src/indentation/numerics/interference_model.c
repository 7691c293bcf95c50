/* A sine in the force, fitted with everything else.
 *
 * Interference adds to the signal of the detector a wave of the path between lever and sample. Out
 * of contact the path is that of the piezo. In contact it changes by the indentation alone, so the
 * wave goes on with a longer period, the longer the stiffer the sample: its phase is taken to be
 * that of the tip, z - P/k, as P is the force of contact. Amplitude and period are taken to be the
 * same all along; that the spot of light moves on the detector and the lever turns are left out. A
 * disturbance that does not come from this path goes on with the height: curve_refine.c tries both.
 *
 * Of the derivatives by the other parameters the parts that the wave imitates are taken out, so
 * that steps, errors and gains follow from them as if there were no wave (Frisch and Waugh).
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "indentation/numerics/curve_model.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <math.h>
#include <string.h>

enum { N = CURVE_N_PARAMETERS, M = WAVE_PARAMETERS };

double curve_wave_cost(const curve_law *m, const double p[N], const curve_wave *wave)
{
    const curve_samples *s = m->samples;
    wt_indent_workspace *w = m->workspace;
    const double a = wave->p[WAVE_COSINE], b = wave->p[WAVE_SINE], number = wave->p[WAVE_NUMBER];
    double sum = 0.0;
    for (size_t i = 0; i < s->n; i++) {
        const bool with_tip = !wave->by_height && fabs(w->g[i]) > 0.0;
        const double path = with_tip ? p[CURVE_C] + w->delta[i] : s->position[i];
        const double cosine = cos(number * path), sine = sin(number * path);
        const double turn = b * cosine - a * sine;
        const double part = p[CURVE_F0] + p[CURVE_T] * (s->position[i] - p[CURVE_C]);
        w->wave_column[WAVE_COSINE][i] = cosine;
        w->wave_column[WAVE_SINE][i] = sine;
        w->wave_column[WAVE_NUMBER][i] = path * turn;
        w->wave_give[i] = with_tip ? 1.0 - number * turn / s->spring_constant : 1.0;
        s->force[i] = w->force[i] - a * cosine - b * sine;
        w->residual[i] = curve_in_gap(s, i) ? 0.0 : s->force[i] - part - p[CURVE_E] * w->g[i];
        sum += w->residual[i] * w->residual[i];
    }
    return sum;
}

bool curve_wave_imitate(curve_law *m, const double p[N], wave_step *to)
{
    const curve_samples *s = m->samples;
    double *const *column = m->workspace->wave_column;
    double ww[M][M] = {{0.0}}, wj[M][N] = {{0.0}}, wr[M] = {0.0}, scale[M], scaled[M * M];
    memset(m->imitated, 0, sizeof m->imitated);
    for (size_t i = 0; i < s->n; i++) {
        if (curve_in_gap(s, i))
            continue;
        double row[N];
        curve_model_row(m, p, i, row);
        for (size_t j = 0; j < M; j++) {
            for (size_t l = 0; l < M; l++)
                ww[j][l] += column[j][i] * column[l][i];
            for (size_t a = 0; a < N; a++)
                wj[j][a] += column[j][i] * row[a];
            wr[j] += column[j][i] * m->workspace->residual[i];
        }
    }
    for (size_t j = 0; j < M; j++) {
        if (!(ww[j][j] > 0.0))
            return false;
        scale[j] = 1.0 / sqrt(ww[j][j]);
    }
    for (size_t j = 0; j < M; j++)
        for (size_t l = 0; l < M; l++)
            scaled[j * M + l] = ww[j][l] * scale[j] * scale[l];
    gsl_matrix_view matrix = gsl_matrix_view_array(scaled, M, M);
    if (gsl_linalg_cholesky_decomp1(&matrix.matrix) != GSL_SUCCESS)
        return false;
    to->gain = 0.0;
    for (size_t a = 0; a <= N; a++) { /* the last one is the step */
        double x[M];
        for (size_t j = 0; j < M; j++)
            x[j] = scale[j] * (a < N ? wj[j][a] : wr[j]);
        gsl_vector_view vector = gsl_vector_view_array(x, M);
        if (gsl_linalg_cholesky_svx(&matrix.matrix, &vector.vector) != GSL_SUCCESS)
            return false;
        for (size_t j = 0; j < M; j++) {
            x[j] *= scale[j];
            if (a < N)
                m->imitated[j][a] = x[j];
            else
                to->gain += x[j] * wr[j];
        }
        if (a == N)
            memcpy(to->step, x, sizeof x);
    }
    return true;
}
