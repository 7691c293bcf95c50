/* Model of a sine in the force that is fitted together with the other parameters.
 *
 * Interference adds to the detector signal a sine of the optical path between cantilever and
 * sample. Out of contact the path is that of the piezo. In contact it changes by the indentation
 * alone, and the period is longer for a stiffer sample. The phase is taken as that of the tip, z -
 * P/k with the contact force P. Amplitude and period are constant; the motion of the laser spot on
 * the detector and the rotation of the cantilever are neglected. A disturbance with another origin
 * depends on the height; least_squares.c tests both.
 *
 * The derivatives by the other parameters exclude their projection on the wave. Steps, errors and
 * gains then follow as without a wave (Frisch and Waugh).
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
        const double phase_derivative = b * cosine - a * sine;
        const double baseline = p[CURVE_F0] + p[CURVE_T] * (s->position[i] - p[CURVE_C]);
        w->wave_column[WAVE_COSINE][i] = cosine;
        w->wave_column[WAVE_SINE][i] = sine;
        w->wave_column[WAVE_NUMBER][i] = path * phase_derivative;
        w->wave_response[i] = with_tip ? 1.0 - number * phase_derivative / s->spring_constant : 1.0;
        s->force[i] = w->force[i] - a * cosine - b * sine;
        w->residual[i] =
            curve_is_in_gap(s, i) ? 0.0 : s->force[i] - baseline - p[CURVE_E] * w->g[i];
        sum += w->residual[i] * w->residual[i];
    }
    return sum;
}

bool curve_wave_project(curve_law *m, const double p[N], wave_step *to)
{
    const curve_samples *s = m->samples;
    double *const *column = m->workspace->wave_column;
    double ww[M][M] = {{0.0}}, wj[M][N] = {{0.0}}, wr[M] = {0.0}, scale[M], scaled[M * M];
    memset(m->wave_projection, 0, sizeof m->wave_projection);
    for (size_t i = 0; i < s->n; i++) {
        if (curve_is_in_gap(s, i))
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
    for (size_t a = 0; a <= N; a++) { /* the last column is the step */
        double x[M];
        for (size_t j = 0; j < M; j++)
            x[j] = scale[j] * (a < N ? wj[j][a] : wr[j]);
        gsl_vector_view vector = gsl_vector_view_array(x, M);
        if (gsl_linalg_cholesky_svx(&matrix.matrix, &vector.vector) != GSL_SUCCESS)
            return false;
        for (size_t j = 0; j < M; j++) {
            x[j] *= scale[j];
            if (a < N)
                m->wave_projection[j][a] = x[j];
            else
                to->gain += x[j] * wr[j];
        }
        if (a == N)
            memcpy(to->step, x, sizeof x);
    }
    return true;
}
