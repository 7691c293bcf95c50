/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "tally.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* Probability below which a deviation is reported. */
static const double by_chance = 1e-4;
static const double covered_right = 0.95, verdicts_right = 0.9, yes_wrong = 0.05;

static int ascending(const void *a, const void *b)
{
    const double *x = a, *y = b;
    return (*x > *y) - (*x < *y);
}

static double median(double *values, size_t n)
{
    if (n == 0)
        return (double)NAN;
    qsort(values, n, sizeof *values, ascending);
    return (values[(n - 1) / 2] + values[n / 2]) / 2;
}

/* Sums over the estimates. */
typedef struct sums {
    int all, stated, covered, finite;
    double square, square_stated;
    double *half_widths;
    size_t n_half_widths;
} sums;

static void take(const observation *o, sums *to)
{
    const bool relative = quantities[o->quantity].relative;
    const estimate *e = &o->found;
    to->all++;
    if (isfinite(e->value)) {
        const double error = (e->value - o->truth) / (relative ? o->truth : 1);
        to->finite++;
        to->square += error * error;
    }
    if (isnan(e->low) || isnan(e->high))
        return;
    to->stated++;
    to->covered += e->low <= o->truth && o->truth <= e->high;
    const double half = (e->high - e->low) / 2 / (relative ? fabs(e->value) : 1);
    if (isfinite(half)) {
        to->half_widths[to->n_half_widths++] = half;
        /* uses the half in which the truth lies, because intervals of a factor are asymmetric */
        const double towards = e->value > o->truth ? e->value - e->low : e->high - e->value;
        to->square_stated += pow(1.96 * (e->value - o->truth) / towards, 2);
    }
}

tally tally_make(const draw *draws, int n, quantity q)
{
    tally t = {.coverage = (double)NAN, .error = (double)NAN};
    sums s = {.half_widths = calloc((size_t)n * OBSERVATIONS_MAX + 1, sizeof *s.half_widths)};
    if (s.half_widths == NULL)
        abort();
    for (int i = 0; i < n; i++) {
        const int all = s.all, stated = s.stated;
        for (int k = 0; k < draws[i].n; k++)
            if (draws[i].observations[k].quantity == q)
                take(&draws[i].observations[k], &s);
        t.draws += s.all > all;
        t.draws_stated += s.stated > stated;
    }
    t.stated = s.all > 0 ? (double)s.stated / s.all : 0;
    t.rms = s.finite > 0 ? sqrt(s.square / s.finite) : (double)NAN;
    t.rms_stated =
        s.n_half_widths > 0 ? sqrt(s.square_stated / (double)s.n_half_widths) : (double)NAN;
    t.half_width = median(s.half_widths, s.n_half_widths);
    if (s.stated > 0) {
        /* the estimates of one draw are correlated; one more draw of each kind avoids a zero
         * error */
        const double p = (double)s.covered / s.stated, m = t.draws_stated;
        const double safe = (p * m + 1) / (m + 2);
        t.coverage = p;
        t.error = sqrt(safe * (1 - safe) / m);
    }
    free(s.half_widths);
    return t;
}

double tally_at_most(int k, int n, double p)
{
    double sum = 0;
    for (int i = 0; i <= k && i <= n; i++)
        sum += exp(lgamma(n + 1.0) - lgamma(i + 1.0) - lgamma(n - i + 1.0) + i * log(p) +
                   (n - i) * log1p(-p));
    return fmin(sum, 1);
}

verdict_tally tally_verdicts(const facts *s, const draw *draws, int n)
{
    verdict_tally t = {.draws = n};
    for (int i = 0; i < n; i++) {
        const draw *d = &draws[i];
        t.said[d->verdict]++;
        t.outcomes[d->outcome]++;
        t.right += (s->right & RIGHT(d->verdict)) != 0;
        t.wrong_yes += d->verdict == YES && (s->right & RIGHT(YES)) == 0;
        t.seconds += d->seconds / n;
    }
    return t;
}

static int complain(FILE *words, const char *where, const char *about, const char *what,
                    double found)
{
    if (words != NULL)
        fprintf(words, "%s %s: %s: %.3g\n", where, about, what, found);
    return 1;
}

/* Number of draws whose intervals contain the truth; a draw with several estimates counts as their
 * share. */
static int draws_covered(const tally *t)
{
    return t->draws_stated > 0 ? (int)floor(t->coverage * t->draws_stated + 0.5) : 0;
}

static int interval_complaints(const facts *s, const draw *draws, int n, FILE *words)
{
    int complaints = 0;
    for (quantity q = 0; q < Q_COUNT; q++) {
        const tally t = tally_make(draws, n, q);
        const char *name = quantities[q].name;
        if (t.draws == 0)
            continue;
        if (t.draws_stated == 0 && (!s->sometimes_silent || pow(0.5, n) < by_chance))
            complaints += complain(words, s->name, name, "no draw states it, share", t.stated);
        if (tally_at_most(draws_covered(&t), t.draws_stated, covered_right) < by_chance)
            complaints +=
                complain(words, s->name, name, "holds the truth too rarely, share", t.coverage);
    }
    return complaints;
}

int tally_complaints(const facts *s, const draw *draws, int n, FILE *words)
{
    const verdict_tally v = tally_verdicts(s, draws, n);
    int complaints = 0;
    if (s->intervals_promised)
        complaints += interval_complaints(s, draws, n, words);
    if (!s->verdict_promised)
        return complaints;
    if (tally_at_most(v.right, n, verdicts_right) < by_chance)
        complaints += complain(words, s->name, "verdict", "right too rarely, draws", v.right);
    if (v.wrong_yes > 0 && 1 - tally_at_most(v.wrong_yes - 1, n, yes_wrong) < by_chance)
        complaints +=
            complain(words, s->name, "verdict", "yes where it is not so, draws", v.wrong_yes);
    return complaints;
}

void tally_add(const facts *s, const draw *draws, int n, pooled_tally *to)
{
    for (quantity q = 0; q < Q_COUNT && s->intervals_promised; q++) {
        const tally t = tally_make(draws, n, q);
        to->draws[q] += t.draws_stated;
        to->covered[q] += draws_covered(&t);
    }
    if (s->verdict_promised) {
        to->verdicts += n;
        to->right += tally_verdicts(s, draws, n).right;
    }
}

int tally_pool_complaints(const pooled_tally *p, FILE *words)
{
    static const char where[] = "promised scenes together:";
    int complaints = 0;
    for (quantity q = 0; q < Q_COUNT; q++)
        if (p->draws[q] > 0 && tally_at_most(p->covered[q], p->draws[q], covered_right) < by_chance)
            complaints +=
                complain(words, where, quantities[q].name, "holds the truth too rarely, share",
                         (double)p->covered[q] / p->draws[q]);
    if (p->verdicts > 0 && tally_at_most(p->right, p->verdicts, verdicts_right) < by_chance)
        complaints += complain(words, where, "verdict", "right too rarely, share",
                               (double)p->right / p->verdicts);
    return complaints;
}
