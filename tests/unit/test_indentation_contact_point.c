/* Contact points by other estimators, against what their definitions say when they are followed by
 * hand, on curves of known contact.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "fitted_curve.h"

#include "indentation/numerics/curve.h"

static wt_indent_fit fit_of(const curve_truth *t, bool estimators)
{
    wt_contact_table *table = NULL;
    wt_indent_options options = wt_indent_defaults();
    wt_indent_fit fit;
    options.misfit_p_threshold = 0;
    options.contact_estimators = estimators;
    assert_int_equal(wt_contact_table_new(&t->tip, 1e-11, 1e-4, &table, NULL), WT_OK);
    assert_int_equal(wt_indent_fit_curve(table, &options, data.height, data.force, data.time, t->n,
                                         t->spring_constant, workspace, &fit, NULL),
                     WT_OK);
    wt_contact_table_free(table);
    assert_int_equal(fit.verdict, WT_CURVE_ACCEPTED);
    return fit;
}

/* Of the sample i: where its tip is, less the fitted contact. */
static double away(const curve_truth *t, const wt_indent_fit *fit, size_t i)
{
    const double z = t->direction * data.height[i] - fit->contact_point.value;
    return z - (data.force[i] - fit->baseline_offset.value - fit->baseline_tilt.value * z) /
                   t->spring_constant;
}

static double mean_of(size_t from, size_t n)
{
    double sum = 0;
    for (size_t i = from; i < from + n; i++)
        sum += data.force[i] / (double)n;
    return sum;
}

static double variance_of(size_t from, size_t n)
{
    const double mean = mean_of(from, n);
    double sum = 0;
    for (size_t i = from; i < from + n; i++)
        sum += (data.force[i] - mean) * (data.force[i] - mean) / (double)n;
    return sum;
}

static size_t threshold_of(const curve_truth *t)
{
    const size_t first = t->n / 10;
    const double mean = mean_of(0, first);
    double most = 0;
    size_t i = 0;
    for (; i < first; i++)
        most = fmax(most, fabs(data.force[i] - mean));
    while (data.force[i] - mean <= 2 * most)
        i++;
    return i;
}

static size_t variances_of(const curve_truth *t)
{
    const size_t w = t->n / 20;
    size_t best = 0;
    double most = 0;
    for (size_t i = w; i + w < t->n; i++) {
        const double ratio = variance_of(i + 1, w) / variance_of(i - w, w);
        if (ratio > most) {
            most = ratio;
            best = i;
        }
    }
    return best;
}

/* Least squares of a constant and a line from one sample on, each by the two normal equations. */
static size_t lines_of(const curve_truth *t)
{
    size_t best = 0;
    double least = (double)INFINITY;
    for (size_t j = 0; j + 1 < t->n; j++) {
        double sx = 0, sxx = 0, sy = 0, sxy = 0, left = 0;
        for (size_t i = 0; i < t->n; i++) {
            const double x = i > j ? fabs(data.height[i] - data.height[j]) : 0;
            sx += x;
            sxx += x * x;
            sy += data.force[i];
            sxy += x * data.force[i];
        }
        const double n = (double)t->n, slope = (n * sxy - sx * sy) / (n * sxx - sx * sx),
                     height = (sy - slope * sx) / n;
        for (size_t i = 0; i < t->n; i++) {
            const double x = i > j ? fabs(data.height[i] - data.height[j]) : 0,
                         r = data.force[i] - height - slope * x;
            left += r * r;
        }
        if (left < least) {
            least = left;
            best = j;
        }
    }
    return best;
}

static size_t direct_path_of(const curve_truth *t)
{
    double low = (double)INFINITY, high = -(double)INFINITY, least = (double)INFINITY;
    size_t best = 0;
    for (size_t i = 0; i < t->n; i++) {
        low = fmin(low, data.force[i]);
        high = fmax(high, data.force[i]);
    }
    for (size_t i = 0; i < t->n; i++) { /* turned by 45 degrees, as its program does */
        const double x = (double)i / (double)(t->n - 1), y = (data.force[i] - low) / (high - low);
        const double turned = -x * sin(M_PI / 4) + y * cos(M_PI / 4);
        if (turned < least) {
            least = turned;
            best = i;
        }
    }
    return best;
}

static void as_defined(void **state)
{
    (void)state;
    for (int falls = 0; falls < 2; falls++) {
        curve_truth t = curve_standard();
        t.n = 800;
        t.tilt = 0;
        t.direction = falls ? -1 : 1;
        curve_make(&t, 17, &data);
        const wt_indent_fit fit = fit_of(&t, true), plain = fit_of(&t, false);
        const double *by = fit.contact_by;
        assert_near_abs(by[WT_CONTACT_THRESHOLD], away(&t, &fit, threshold_of(&t)), 1e-13);
        assert_near_abs(by[WT_CONTACT_VARIANCES], away(&t, &fit, variances_of(&t)), 1e-13);
        assert_near_abs(by[WT_CONTACT_LINES], away(&t, &fit, lines_of(&t)), 1e-13);
        assert_near_abs(by[WT_CONTACT_DIRECT_PATH], away(&t, &fit, direct_path_of(&t)), 1e-13);
        /* they come late: two lines by a part of the indentation, a threshold when the force leaves
         * the noise; a fit of the right law does not, but for its bias on a soft lever */
        assert_true(by[WT_CONTACT_LINES] > 0.1 * fit.max_indentation);
        assert_true(by[WT_CONTACT_THRESHOLD] > 0 &&
                    by[WT_CONTACT_THRESHOLD] < 0.1 * fit.max_indentation);
        assert_near_abs(by[WT_CONTACT_GOODNESS_OF_FIT], 0, 0.02 * fit.max_indentation);
        /* and never are the answer */
        assert_near(plain.modulus.value, fit.modulus.value, 0);
        assert_near(plain.contact_point.value, fit.contact_point.value, 0);
        for (int i = 0; i < WT_CONTACT_ESTIMATORS; i++)
            assert_true(isnan(plain.contact_by[i]));
    }
}

/* Forces in steps as coarse as the noise: the baseline has no variance, and rounding finds none. */
static void in_coarse_steps(void **state)
{
    (void)state;
    const double step = 1e-10;
    for (int moved = 0; moved < 2; moved++) {
        curve_truth t = curve_standard();
        t.noise = 0.02 * step;
        t.tilt = 0;
        curve_make(&t, 3, &data);
        for (size_t i = 0; i < t.n; i++)
            data.force[i] = step * round(data.force[i] / step) + (moved ? 1.2345e-8 : 0);
        const wt_indent_fit fit = fit_of(&t, true);
        assert_true(isnan(fit.contact_by[WT_CONTACT_VARIANCES]));
        assert_true(!isnan(fit.contact_by[WT_CONTACT_THRESHOLD]));
    }
}

/* Without noise the fit by force against indentation has the true contact. */
static void without_noise(void **state)
{
    (void)state;
    curve_truth t = curve_standard();
    t.noise = 0;
    curve_make(&t, 0, &data);
    const wt_indent_fit fit = fit_of(&t, true);
    assert_near_abs(fit.contact_by[WT_CONTACT_GOODNESS_OF_FIT], 0, 1e-3 * fit.max_indentation);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(as_defined),
                                       cmocka_unit_test(in_coarse_steps),
                                       cmocka_unit_test(without_noise)};
    return cmocka_run_group_tests(tests, make_workspace, free_workspace);
}
