/* main.xml of an X3P file: what the axes are, how many points there are, where their heights stand.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_READ_X3P_DOCUMENT_H
#define WT_READ_X3P_DOCUMENT_H

#include "read/bytes/samples.h"
#include "weartrack/base.h"

typedef struct x3p_axis {
    bool incremental;
    sample_type type;         /* of Z alone that of the data */
    double increment, offset; /* [m]; NaN: not there */
} x3p_axis;

enum { X3P_LINK = 128 };

typedef struct x3p_document {
    char feature[8]; /* SUR or PRF */
    x3p_axis axis[3];
    size_t size[3];                         /* of the matrix: x, y, layers */
    char points[X3P_LINK], valid[X3P_LINK]; /* entries beside main.xml; "" = none */
    char points_md5[40];                    /* of the first, "" = not said */
    double *list;                           /* [n_list] heights in the document itself, raw */
    size_t n_list;
} x3p_document;

/* The document is to be cleared after a failure, too. WT_E_UNSUPPORTED: not a matrix of heights. */
wt_status x3p_document_parse(const void *xml, size_t length, x3p_document *document,
                             wt_error *err) WT_NODISCARD;
void x3p_document_clear(x3p_document *document);

#endif
