/* WLF and Arrhenius laws fitted to shift factors by generalised least squares.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "fit/wlf_fit.h"

#include "base/gsl_quiet.h"
#include "fit/pool_gsl.h"

#include <gsl/gsl_blas.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <gsl/gsl_multifit.h>
#include <gsl/gsl_multifit_nlinear.h>
#include <math.h>

/* Unknowns: c1 = exp(q), c2 = lead + farthest/(1 + exp(-p)), offset. `lead` is the distance from
 * the coldest isotherm to the reference, so the pole stays below all data whatever p is. */
enum { Q, P, OFFSET, N_WLF };

/* Beyond this c2 the law is a straight line over any measurable range [K]. */
static const double straight_c2 = 1000.0;
/* Largest distance of the pole below the coldest isotherm [K]: straight to 1 % over 100 K. */
static const double farthest = 1e4;

static double above_pole_of(double p)
{
    return farthest / (1.0 + exp(-p));
}

struct problem {
    pool memory;
    size_t n;
    const double *temperature, *log_a;
    double reference, lead;
    gsl_matrix *root;   /* lower Cholesky factor of the covariance */
    gsl_vector *column; /* [n] scratch */
    gsl_matrix *linear; /* n x 2 whitened design of the linear laws */
    gsl_vector *white;  /* [n] whitened log_a */
    gsl_multifit_linear_workspace *line;
    gsl_multifit_nlinear_workspace *law;
    gsl_matrix *line_cov, *law_cov; /* of the fit that was the last */
};

static void problem_free(struct problem *problem)
{
    gsl_multifit_linear_free(problem->line);
    if (problem->law != NULL)
        gsl_multifit_nlinear_free(problem->law);
    pool_free(&problem->memory);
}

static void whiten(const struct problem *problem, gsl_vector *v)
{
    gsl_blas_dtrsv(CblasLower, CblasNoTrans, CblasNonUnit, problem->root, v);
}

static wt_status problem_init(struct problem *problem, const double *covariance, double floor,
                              wt_error *err)
{
    const gsl_multifit_nlinear_parameters settings = gsl_multifit_nlinear_default_parameters();
    const size_t n = problem->n;
    problem->root = pool_matrix(&problem->memory, n, n);
    problem->column = pool_vector(&problem->memory, n);
    problem->linear = pool_matrix(&problem->memory, n, 2);
    problem->white = pool_vector(&problem->memory, n);
    problem->line_cov = pool_matrix(&problem->memory, 2, 2);
    problem->law_cov = pool_matrix(&problem->memory, N_WLF, N_WLF);
    problem->line = gsl_multifit_linear_alloc(n, 2);
    problem->law = gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &settings, n, N_WLF);
    if (problem->memory.failed || problem->line == NULL || problem->law == NULL)
        return wt_fail(err, WT_E_MEMORY, "no memory for %zu shift factors", n);
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++)
            gsl_matrix_set(problem->root, i, j,
                           0.5 * (covariance[i * n + j] + covariance[j * n + i]) +
                               (i == j ? floor * floor : 0.0));
    if (gsl_linalg_cholesky_decomp1(problem->root) != GSL_SUCCESS) {
        wt_status status =
            wt_fail(err, WT_E_CONVERGENCE, "the covariance of the shifts is not positive");
        wt_error_advice(err, "use a larger floor of the shift error than %g decade", floor);
        return status;
    }
    for (size_t i = 0; i < n; i++)
        gsl_vector_set(problem->white, i, problem->log_a[i]);
    whiten(problem, problem->white);
    return WT_OK;
}

static int residuals(const gsl_vector *unknown, void *parameters, gsl_vector *f)
{
    const struct problem *problem = parameters;
    const double c1 = exp(gsl_vector_get(unknown, Q));
    const double c2 = problem->lead + above_pole_of(gsl_vector_get(unknown, P));
    for (size_t i = 0; i < problem->n; i++) {
        const double rise = problem->temperature[i] - problem->reference;
        gsl_vector_set(
            f, i, gsl_vector_get(unknown, OFFSET) - c1 * rise / (c2 + rise) - problem->log_a[i]);
    }
    whiten(problem, f);
    return GSL_SUCCESS;
}

static int jacobian(const gsl_vector *unknown, void *parameters, gsl_matrix *derivative)
{
    const struct problem *problem = parameters;
    const double c1 = exp(gsl_vector_get(unknown, Q));
    const double above = above_pole_of(gsl_vector_get(unknown, P));
    const double slope = above * (1.0 - above / farthest); /* d c2 / d p */
    const double c2 = problem->lead + above;
    for (size_t i = 0; i < problem->n; i++) {
        const double rise = problem->temperature[i] - problem->reference;
        const double u = rise / (c2 + rise);
        gsl_matrix_set(derivative, i, Q, -c1 * u);
        gsl_matrix_set(derivative, i, P, c1 * u * (slope / (c2 + rise)));
        gsl_matrix_set(derivative, i, OFFSET, 1.0);
    }
    for (size_t k = 0; k < N_WLF; k++) {
        gsl_vector_view column = gsl_matrix_column(derivative, k);
        whiten(problem, &column.vector);
    }
    return GSL_SUCCESS;
}

/* Generalised least squares of log_a = offset + factor * regressor (in problem->column).
 * line_cov: of (offset, factor) for the variances as given. */
static wt_status fit_linear(struct problem *problem, double result[2], double *chi_square,
                            wt_error *err)
{
    gsl_vector_view view = gsl_vector_view_array(result, 2);
    gsl_vector_view one = gsl_matrix_column(problem->linear, 0);
    gsl_vector_view regressor = gsl_matrix_column(problem->linear, 1);
    gsl_vector_set_all(&one.vector, 1.0);
    gsl_vector_memcpy(&regressor.vector, problem->column);
    whiten(problem, &one.vector);
    whiten(problem, &regressor.vector);
    if (gsl_multifit_linear(problem->linear, problem->white, &view.vector, problem->line_cov,
                            chi_square, problem->line) != GSL_SUCCESS)
        return wt_fail(err, WT_E_CONVERGENCE, "the straight line through the shifts is singular");
    /* gsl scales by chi^2/(n - 2); the covariance of the shifts is known here. */
    if (*chi_square > 0.0)
        gsl_matrix_scale(problem->line_cov, (double)(problem->n - 2) / *chi_square);
    return WT_OK;
}

/* Akaike's criterion for small samples; NaN if there are too few shifts for it. */
static double aicc(double chi_square, size_t n, size_t n_parameters)
{
    const double k = (double)n_parameters + 1.0; /* the scale of the residuals is one more */
    const double count = (double)n;
    if (count - k - 1.0 <= 0.0)
        return (double)NAN;
    return count * log(chi_square / count) + 2.0 * k + 2.0 * k * (k + 1.0) / (count - k - 1.0);
}

/* Errors grow when the shifts scatter more about the law than their covariance says. */
static double scatter_factor(double chi_square, size_t n, size_t n_parameters)
{
    return fmax(sqrt(chi_square / (double)(n - n_parameters)), 1.0);
}

/* Levenberg-Marquardt from c2 = start_c2, with the best c1 and offset for it. */
static wt_status fit_from(struct problem *problem, double above_pole, double unknown[N_WLF],
                          double *chi_square, wt_error *err)
{
    gsl_multifit_nlinear_workspace *workspace = problem->law;
    double line[2], ignored;
    for (size_t i = 0; i < problem->n; i++) {
        const double rise = problem->temperature[i] - problem->reference;
        gsl_vector_set(problem->column, i, -rise / (problem->lead + above_pole + rise));
    }
    wt_status status = fit_linear(problem, line, &ignored, err);
    if (status != WT_OK)
        return status;
    unknown[Q] = log(line[1] > 0.0 ? line[1] : 1.0);
    unknown[P] = log(above_pole / (farthest - above_pole));
    unknown[OFFSET] = line[0];
    gsl_multifit_nlinear_fdf fdf = {
        .f = residuals, .df = jacobian, .n = problem->n, .p = N_WLF, .params = problem};
    gsl_vector_view start = gsl_vector_view_array(unknown, N_WLF);
    int info;
    if (gsl_multifit_nlinear_init(&start.vector, &fdf, workspace) != GSL_SUCCESS)
        return wt_fail(err, WT_E_CONVERGENCE, "the WLF fit could not start");
    /* A straight line drives c2 to infinity: there the iteration limit is an answer too. */
    const int code =
        gsl_multifit_nlinear_driver(200, 1e-10, 1e-12, 1e-14, NULL, NULL, &info, workspace);
    if (code != GSL_SUCCESS && code != GSL_EMAXITER && code != GSL_ENOPROG)
        return wt_fail(err, WT_E_CONVERGENCE, "the WLF fit failed: %s", gsl_strerror(code));
    for (size_t k = 0; k < N_WLF; k++)
        unknown[k] = gsl_vector_get(gsl_multifit_nlinear_position(workspace), k);
    gsl_blas_ddot(gsl_multifit_nlinear_residual(workspace),
                  gsl_multifit_nlinear_residual(workspace), chi_square);
    if (!isfinite(*chi_square) || gsl_multifit_nlinear_covar(gsl_multifit_nlinear_jac(workspace),
                                                             0.0, problem->law_cov) != GSL_SUCCESS)
        return wt_fail(err, WT_E_CONVERGENCE, "the WLF fit failed");
    return WT_OK;
}

/* Carries the covariance of (q, p, offset) over to what is reported. A straight line has a slope
 * and no more: its errors of c1, c2 and what follows from them are not known. */
static void fill_wlf(const struct problem *problem, const double unknown[N_WLF], double chi_square,
                     wt_wlf_fit *fit)
{
    const gsl_matrix *cov = problem->law_cov;
    const double factor = scatter_factor(chi_square, problem->n, N_WLF);
    const double c1 = exp(unknown[Q]), above = above_pole_of(unknown[P]);
    const double c2 = problem->lead + above;
    const double slope = above * (1.0 - above / farthest);
    const double s1 = c1 * sqrt(gsl_matrix_get(cov, Q, Q)) * factor;
    const double s2 = slope * sqrt(gsl_matrix_get(cov, P, P)) * factor;
    const double s12 = c1 * slope * gsl_matrix_get(cov, Q, P) * factor * factor;
    fit->wlf = (wt_wlf){problem->reference, c1, c2};
    fit->c1_error = s1;
    fit->c2_error = s2;
    fit->correlation = s12 / (s1 * s2);
    fit->b = c1 * c2;
    fit->b_error = sqrt(fmax(c2 * c2 * s1 * s1 + c1 * c1 * s2 * s2 + 2.0 * c1 * c2 * s12, 0.0));
    fit->pole = problem->reference - c2;
    fit->pole_error = s2;
    fit->slope = -c1 / c2;
    fit->slope_error =
        c1 / c2 *
        sqrt(fmax(s1 * s1 / (c1 * c1) + s2 * s2 / (c2 * c2) - 2.0 * s12 / (c1 * c2), 0.0));
    fit->offset = unknown[OFFSET];
    fit->offset_error = sqrt(gsl_matrix_get(cov, OFFSET, OFFSET)) * factor;
    fit->aicc_wlf = aicc(chi_square, problem->n, N_WLF);
    fit->straight = !(c2 <= straight_c2) || !(s2 <= c2);
    if (fit->straight) {
        fit->c1_error = fit->c2_error = fit->correlation = (double)NAN;
        fit->b_error = fit->pole_error = (double)NAN;
    }
}

static double weighted_rms(const struct problem *problem, const double *covariance, double floor,
                           const wt_wlf_fit *fit)
{
    double square = 0.0, weights = 0.0;
    for (size_t i = 0; i < problem->n; i++) {
        const double w = 1.0 / (covariance[i * problem->n + i] + floor * floor);
        const double r =
            problem->log_a[i] - fit->offset - wt_wlf_log_shift(&fit->wlf, problem->temperature[i]);
        square += w * r * r;
        weights += w;
    }
    return sqrt(square / weights);
}

static wt_status check_falls(double slope, wt_error *err)
{
    if (slope < 0.0)
        return WT_OK;
    wt_status status = wt_fail(err, WT_E_RANGE, "the shift factors do not fall with temperature");
    wt_error_expected(err, "log10 aT falling from cold to warm");
    wt_error_found(err, "%+.3g decade/K on average", slope);
    wt_error_advice(err, "check the temperatures of the isotherms and the sign of the shifts");
    return status;
}

/* A law with one factor, offset + factor * regressor (in problem->column), with its error. */
static wt_status fit_factor(struct problem *problem, double *factor, double *error,
                            double *criterion, wt_error *err)
{
    double line[2], chi_square;
    wt_status status = fit_linear(problem, line, &chi_square, err);
    if (status != WT_OK)
        return status;
    *factor = line[1];
    *error =
        sqrt(gsl_matrix_get(problem->line_cov, 1, 1)) * scatter_factor(chi_square, problem->n, 2);
    *criterion = aicc(chi_square, problem->n, 2);
    return WT_OK;
}

/* The straight line, by which shifts that do not fall are refused, and Arrhenius' law. */
static wt_status fit_lines(struct problem *problem, double *slope, double *slope_error,
                           wt_wlf_fit *fit, wt_error *err)
{
    double ignored;
    for (size_t i = 0; i < problem->n; i++)
        gsl_vector_set(problem->column, i, problem->temperature[i] - problem->reference);
    wt_status status = fit_factor(problem, slope, slope_error, &ignored, err);
    if (status == WT_OK)
        status = check_falls(*slope, err);
    for (size_t i = 0; i < problem->n; i++)
        gsl_vector_set(problem->column, i,
                       wt_arrhenius_log_shift(1.0, problem->reference, problem->temperature[i]));
    if (status == WT_OK)
        status = fit_factor(problem, &fit->activation_energy, &fit->activation_energy_error,
                            &fit->aicc_arrhenius, err);
    return status;
}

/* The best of fits from several starts: the cost has side minima. */
static wt_status fit_law(struct problem *problem, wt_wlf_fit *fit, wt_error *err)
{
    /* Distance of the pole below the coldest isotherm to start from [K]. */
    static const double starts[] = {10.0, 40.0, 150.0, 600.0};
    double best = HUGE_VAL, chi_square;
    wt_status status = WT_OK;
    for (size_t k = 0; k < sizeof starts / sizeof *starts; k++) {
        double unknown[N_WLF];
        status = fit_from(problem, starts[k], unknown, &chi_square, err);
        if (status == WT_OK && chi_square < best) {
            best = chi_square;
            fill_wlf(problem, unknown, chi_square, fit);
        }
    }
    return best < HUGE_VAL ? WT_OK : status; /* the last failure */
}

wt_status wlf_fit_arrays(const double *temperature, const double *log_a, const double *covariance,
                         size_t n, double reference_temperature, double floor, wt_wlf_fit *fit,
                         wt_error *err)
{
    struct problem problem = {
        .n = n, .temperature = temperature, .log_a = log_a, .reference = reference_temperature};
    wt_wlf_fit made = {.n = n};
    double slope, slope_error;

    gsl_quiet();
    if (!(reference_temperature > 0.0) || !(floor > 0.0) || n <= N_WLF) {
        wt_status bad =
            wt_fail(err, n <= N_WLF ? WT_E_MISSING : WT_E_RANGE, "no WLF fit of %zu shifts", n);
        wt_error_expected(err,
                          "at least %d determined shifts, a reference temperature above 0 K, "
                          "a floor above 0",
                          N_WLF + 1);
        wt_error_found(err, "%zu shifts, %g K, floor %g decade", n, reference_temperature, floor);
        return bad;
    }
    double coldest = reference_temperature;
    for (size_t i = 0; i < n; i++)
        coldest = fmin(coldest, temperature[i]);
    problem.lead = reference_temperature - coldest;
    wt_status status = problem_init(&problem, covariance, floor, err);
    if (status == WT_OK)
        status = fit_lines(&problem, &slope, &slope_error, &made, err);
    if (status == WT_OK)
        status = fit_law(&problem, &made, err);
    if (status == WT_OK) {
        if (made.straight) {
            made.slope = slope;
            made.slope_error = slope_error;
        }
        made.rms = weighted_rms(&problem, covariance, floor, &made);
        *fit = made;
    }
    problem_free(&problem);
    return status;
}

wt_status wt_wlf_fit_shifts(const wt_master_curve *master, double floor, wt_wlf_fit *fit,
                            wt_error *err)
{
    const size_t n_all = master->n_shifts;
    size_t n = 0;
    pool memory = {0};
    double *temperature = pool_numbers(&memory, n_all), *log_a = pool_numbers(&memory, n_all);
    double *covariance = pool_numbers(&memory, n_all * n_all);
    size_t *index = pool_alloc(&memory, n_all, sizeof *index);
    wt_status status = WT_OK;
    if (memory.failed)
        status = wt_fail(err, WT_E_MEMORY, "no memory for %zu shift factors", n_all);
    for (size_t i = 0; i < n_all && status == WT_OK; i++)
        if (master->shifts[i].determined) {
            temperature[n] = master->shifts[i].temperature;
            log_a[n] = master->shifts[i].log_a.value;
            index[n++] = i;
        }
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++)
            covariance[i * n + j] = master->covariance[index[i] * n_all + index[j]];
    if (status == WT_OK)
        status = wlf_fit_arrays(temperature, log_a, covariance, n, master->reference_temperature,
                                floor, fit, err);
    pool_free(&memory);
    return status;
}
