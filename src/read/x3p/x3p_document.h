/* Declares main.xml of an X3P file: its axes, the number of points and the source of the heights.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_READ_X3P_DOCUMENT_H
#define WT_READ_X3P_DOCUMENT_H

#include "read/bytes/samples.h"
#include "weartrack/core.h"

typedef struct x3p_axis {
    bool incremental;
    sample_type type;         /* data type; used for Z only */
    double increment, offset; /* [m]; NaN if absent */
} x3p_axis;

enum { X3P_LINK = 128 };

typedef struct x3p_document {
    char feature[8]; /* SUR or PRF */
    x3p_axis axis[3];
    size_t size[3];                         /* size of the matrix: x, y, layers */
    char points[X3P_LINK], valid[X3P_LINK]; /* entries relative to main.xml; "" if absent */
    char points_md5[40];                    /* MD5 checksum of `points`; "" if absent */
    double *list;                           /* [n_list] raw heights in the document itself */
    size_t n_list;
} x3p_document;

/* Parses a document; the caller clears it, also after a failure. WT_E_UNSUPPORTED for other data
 * than a matrix of heights. */
wt_status x3p_document_parse(const void *xml, size_t length, x3p_document *document,
                             wt_error *err) WT_NODISCARD;
void x3p_document_clear(x3p_document *document);

#endif
