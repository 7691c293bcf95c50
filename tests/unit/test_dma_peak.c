/* Peaks of curves against temperature and values between points: coverage of the intervals, no peak
 * where there is none.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"
#include "draw_count.h"
#include "weartrack/dma.h"

#include "dma_data.h"

/* A Havriliak-Negami process, which is asymmetric, with a network. */
typedef struct rubber {
    double glassy, rubbery, width, skew;
    double c1, c2, reference; /* WLF, degC */
} rubber;

static double value(const rubber *r, double celsius, bool factor)
{
    const double log_a = -r->c1 * (celsius - r->reference) / (r->c2 + celsius - r->reference);
    /* E = glassy - (glassy - rubbery) / (1 + (i w tau)^width)^skew */
    const double m = pow(2 * M_PI * pow(10, log_a), r->width);
    const double re = 1 + m * cos(r->width * M_PI / 2), im = m * sin(r->width * M_PI / 2);
    const double part = (r->glassy - r->rubbery) * pow(hypot(re, im), -r->skew),
                 angle = r->skew * atan2(im, re);
    const double storage = r->glassy - part * cos(angle), loss = part * sin(angle);
    return factor ? loss / storage : loss;
}

static double true_peak(const rubber *r, bool factor)
{
    double at = r->reference, best = 0;
    for (double t = r->reference - 30; t < r->reference + 70; t += 0.005)
        if (value(r, t, factor) > best) {
            best = value(r, t, factor);
            at = t;
        }
    return at;
}

enum { DRAWS = DRAW_COUNT(200), MOST = 400 };
static const rubber rubbers[] = {{2e9, 3e6, 0.6, 0.8, 12, 50, -40},
                                 {1.5e9, 8e6, 0.5, 0.9, 14, 55, -20},
                                 {2e9, 5e6, 0.75, 0.6, 14, 45, 0},
                                 {2.5e9, 2e6, 0.55, 1, 11, 60, 10}};
static const double steps[] = {0.5, 1, 2, 3}, noises[] = {0.003, 0.01, 0.02};

/* 200 sweeps of one rubber, with different steps and noise. */
static size_t measure(size_t draw, bool factor, double *x, double *y, uint64_t *state,
                      const rubber **of)
{
    const rubber *r = *of = &rubbers[draw % 4];
    const double step = steps[draw / 4 % 4], noise = noises[draw / 16 % 3];
    const double first = r->reference - 35 + step * (double)(draw % 7) / 7;
    size_t n = 0;
    for (double t = first; t < r->reference + 80; t += step) {
        x[n] = t;
        y[n++] = value(r, t, factor) * exp(noise * dma_normal(state));
    }
    return n;
}

static void peaks_hold_the_truth(void **unused)
{
    (void)unused;
    for (int factor = 0; factor < 2; factor++) {
        uint64_t state = 7;
        size_t held = 0, found = 0;
        for (size_t draw = 0; draw < DRAWS; draw++) {
            double x[MOST], y[MOST];
            const rubber *r;
            wt_peak peak;
            const size_t n = measure(draw, factor, x, y, &state, &r);
            assert_int_equal(wt_peak_find(x, y, n, &peak, NULL), WT_OK);
            if (!peak.found)
                continue;
            const double truth = true_peak(r, factor);
            found++;
            held += peak.at.low <= truth && truth <= peak.at.high;
            assert_true(peak.at.low < peak.at.value && peak.at.value < peak.at.high);
            assert_string_equal(peak.reason, "");
            assert_true(peak.misfit < 0.05 && peak.n >= 9);
        }
        print_message("peak of %s: %zu of %zu\n", factor ? "tan delta" : "E''", held, found);
        if (!TEST_RATES)
            continue;
        assert_true(found > DRAWS * 95 / 100);
        assert_true((double)held > 0.92 * (double)found && (double)held <= 0.98 * (double)found);
    }
}

/* By definition: tangents of ln E' at the steepest point and, on the cold side, at a tenth of that
 * slope. */
static double log_storage(const rubber *r, double celsius)
{
    const double factor = value(r, celsius, true);
    return log(value(r, celsius, false) / factor);
}

static double true_onset(const rubber *r)
{
    const double h = 0.01;
    double steepest = 0, inflection = 0, slope = 0;
    for (double t = r->reference - 30; t < r->reference + 70; t += h) {
        slope = (log_storage(r, t + h) - log_storage(r, t - h)) / (2 * h);
        inflection = slope < steepest ? t : inflection;
        steepest = fmin(slope, steepest);
    }
    double glass = inflection;
    do {
        glass -= h;
        slope = (log_storage(r, glass + h) - log_storage(r, glass - h)) / (2 * h);
    } while (slope < 0.1 * steepest);
    return (log_storage(r, inflection) - log_storage(r, glass) + slope * glass -
            steepest * inflection) /
           (slope - steepest);
}

static void onsets_hold_the_truth(void **unused)
{
    (void)unused;
    uint64_t state = 5;
    size_t held = 0, found = 0;
    double width = 0;
    for (size_t draw = 0; draw < DRAWS; draw++) {
        double x[MOST], y[MOST];
        const rubber *r;
        wt_onset onset;
        const size_t n = measure(draw, false, x, y, &state, &r);
        for (size_t i = 0; i < n; i++) /* the same scatter, of the storage modulus */
            y[i] *= exp(log_storage(r, x[i])) / value(r, x[i], false);
        assert_int_equal(wt_onset_find(x, y, n, &onset, NULL), WT_OK);
        if (!onset.found)
            continue;
        const double truth = true_onset(r);
        found++;
        held += onset.at.low <= truth && truth <= onset.at.high;
        width += onset.at.high - onset.at.low;
    }
    print_message("onset: %zu of %zu, %.2f K wide\n", held, found, width / (double)found);
    if (!TEST_RATES)
        return;
    assert_true(found > DRAWS * 95 / 100);
    assert_true((double)held >= 0.92 * (double)found && (double)held <= 0.98 * (double)found);
}

/* No peak if the sweep begins in the fall, if nothing falls, or with few points. */
static void no_onset(void **unused)
{
    (void)unused;
    double x[60], y[60];
    wt_onset onset;
    for (int i = 0; i < 60; i++) {
        x[i] = i;
        y[i] = exp(18 - 0.1 * i);
    }
    assert_int_equal(wt_onset_find(x, y, 60, &onset, NULL), WT_OK);
    assert_false(onset.found);
    assert_true(isnan(onset.at.value));
    assert_non_null(strstr(onset.reason, "do not show both"));
    assert_int_equal(wt_onset_find(x, y, 4, &onset, NULL), WT_OK);
    assert_non_null(strstr(onset.reason, "fewer than 5"));
    for (int i = 0; i < 60; i++)
        y[i] = exp(18 - 0.001 * i);
    assert_int_equal(wt_onset_find(x, y, 60, &onset, NULL), WT_OK);
    assert_non_null(strstr(onset.reason, "less than a factor 2"));
}

static void values_hold_the_truth(void **unused)
{
    uint64_t state = 11;
    size_t held = 0;
    (void)unused;
    for (size_t draw = 0; draw < DRAWS; draw++) {
        double x[MOST], y[MOST];
        const rubber *r;
        wt_interval got;
        const bool factor = draw % 2 == 0;
        const size_t n = measure(draw, factor, x, y, &state, &r);
        const double at = r->reference - 20 + 90 * (double)draw / DRAWS;
        assert_int_equal(wt_smooth_interpolate(x, y, n, at, &got, NULL), WT_OK);
        assert_true(got.low < got.value && got.value < got.high);
        const double truth = value(r, at, factor);
        held += got.low <= truth && truth <= got.high;
    }
    print_message("values: %zu of %d\n", held, DRAWS);
    if (!TEST_RATES)
        return;
    assert_true(held >= 184 && held <= 196);
}

/* No value outside the points, and no peak of a monotone or scattered line. */
static void no_peak(void **unused)
{
    double x[60], y[60];
    uint64_t state = 3;
    wt_peak peak;
    wt_interval got;
    size_t false_ones = 0;
    (void)unused;
    for (int i = 0; i < 60; i++) {
        x[i] = i;
        y[i] = exp(0.05 * i);
    }
    assert_int_equal(wt_peak_find(x, y, 60, &peak, NULL), WT_OK);
    assert_false(peak.found);
    assert_true(isnan(peak.at.value));
    assert_non_null(strstr(peak.reason, "largest at the highest temperatures"));
    for (int i = 0; i < 60; i++)
        y[i] = exp(-0.05 * i);
    y[1] = 2;
    assert_int_equal(wt_peak_find(x, y, 60, &peak, NULL), WT_OK);
    assert_non_null(strstr(peak.reason, "no peak in range: largest at the lowest"));
    assert_int_equal(wt_peak_find(x, y, 4, &peak, NULL), WT_OK);
    assert_non_null(strstr(peak.reason, "fewer than 5"));
    for (int k = 0; k < 100; k++) {
        for (int i = 0; i < 60; i++)
            y[i] = exp(0.02 * dma_normal(&state));
        assert_int_equal(wt_peak_find(x, y, 60, &peak, NULL), WT_OK);
        false_ones += peak.found;
    }
    print_message("peaks of scatter: %zu of 100\n", false_ones);
    assert_true(false_ones <= 10);
    assert_int_equal(wt_smooth_interpolate(x, y, 60, 59.5, &got, NULL), WT_OK);
    assert_true(isnan(got.value) && isnan(got.low));
    assert_int_equal(wt_smooth_interpolate(x, y, 4, 2, &got, NULL), WT_OK);
    assert_true(isnan(got.value));
}

/* A blend of two rubbers, the second with a lower peak: maxima of the sum. */
static double blend(double celsius, double share)
{
    return exp(-pow((celsius + 45) / 9, 2)) + share * exp(-pow((celsius - 5) / 12, 2)) + 0.03;
}

static double true_top(double from, double to, double share)
{
    double at = from;
    for (double t = from; t < to; t += 0.002)
        at = blend(t, share) > blend(at, share) ? t : at;
    return at;
}

static void lower_peaks_are_found(void **unused)
{
    (void)unused;
    uint64_t state = 11;
    size_t held = 0, found = 0, wrong = 0;
    for (size_t draw = 0; draw < DRAWS; draw++) {
        const double share = 0.15 + 0.1 * (double)(draw % 8), step = steps[draw / 8 % 3];
        double x[MOST], y[MOST];
        size_t n = 0, n_peaks = 0;
        wt_peak peaks[4];
        for (double t = -80 + 0.1 * (double)(draw % 9); t < 60; t += step) {
            x[n] = t;
            y[n++] = blend(t, share) * exp(0.01 * dma_normal(&state));
        }
        assert_int_equal(wt_secondary_peaks(x, y, n, 4, peaks, &n_peaks, NULL), WT_OK);
        const double truth = true_top(-10, 20, share);
        for (size_t i = 0; i < n_peaks; i++)
            wrong += fabs(peaks[i].at.value - truth) > 5;
        if (n_peaks != 1)
            continue;
        found++;
        held += peaks[0].at.low <= truth && truth <= peaks[0].at.high;
    }
    print_message("lower peaks: %zu of %zu found, %zu of them held, %zu wrong\n", found,
                  (size_t)DRAWS, held, wrong);
    if (!TEST_RATES)
        return;
    assert_true((double)found > 0.97 * DRAWS);
    assert_true((double)held > 0.91 * (double)found);
    assert_true(wrong <= 2);
}

/* A peak with scatter has no second peak, and neither has a shoulder. */
static void no_lower_peak(void **unused)
{
    (void)unused;
    uint64_t state = 3;
    size_t wrong = 0;
    for (size_t draw = 0; draw < DRAWS; draw++) {
        double x[MOST], y[MOST];
        const rubber *r;
        wt_peak peaks[4];
        size_t n_peaks = 0;
        const size_t n = measure(draw, draw % 2 == 0, x, y, &state, &r);
        assert_int_equal(wt_secondary_peaks(x, y, n, 4, peaks, &n_peaks, NULL), WT_OK);
        wrong += n_peaks;
    }
    print_message("no lower peak: %zu in %zu sweeps\n", wrong, (size_t)DRAWS);
    assert_true(wrong <= 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(peaks_hold_the_truth),
                                       cmocka_unit_test(onsets_hold_the_truth),
                                       cmocka_unit_test(no_onset),
                                       cmocka_unit_test(values_hold_the_truth),
                                       cmocka_unit_test(no_peak),
                                       cmocka_unit_test(lower_peaks_are_found),
                                       cmocka_unit_test(no_lower_peak)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
