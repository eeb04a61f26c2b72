// The first eight of a list that is in no order, as many as registers hold well; those behind them are a second look at the list.

// One of a list.
struct Sorted {
    // Bits of a depth; the least is the nearest and comes first.
    depth: u32,
    // Of those that are equally deep the least comes first.
    order: u32,
    // What it stands for; nobody compares it.
    number: u32,
}

// Behind all others.
const NONE: Sorted = Sorted(0xffffffffu, 0xffffffffu, 0u);

// In order.
struct FirstEight {
    a: Sorted,
    b: Sorted,
    c: Sorted,
    d: Sorted,
    e: Sorted,
    f: Sorted,
    g: Sorted,
    h: Sorted,
}

const EMPTY: FirstEight = FirstEight(NONE, NONE, NONE, NONE, NONE, NONE, NONE, NONE);

// Whether so many are asked for.
override THREE_OR_MORE: bool = true;
override FIVE_OR_MORE: bool = true;
override SEVEN_OR_MORE: bool = true;
// Whether of those that are equal in depth and order one is kept.
override ONCE_EACH: bool = false;

fn is_before(a: Sorted, b: Sorted) -> bool {
    return a.depth < b.depth || (a.depth == b.depth && a.order < b.order);
}

// Keeps the first of two, and goes on with the other one.
fn sort(kept: ptr<function, Sorted>, other: ptr<function, Sorted>) {
    let a = *kept;
    let b = *other;
    let is_same = ONCE_EACH && a.depth == b.depth && a.order == b.order;
    let swaps = is_before(b, a);
    let takes = swaps || is_same;
    *kept = Sorted(select(a.depth, b.depth, takes), select(a.order, b.order, takes), select(a.number, b.number, takes));
    let passes = vec3(select(b.depth, a.depth, swaps), select(b.order, a.order, swaps), select(b.number, a.number, swaps));
    *other = Sorted(
        select(passes.x, NONE.depth, is_same),
        select(passes.y, NONE.order, is_same),
        select(passes.z, NONE.number, is_same),
    );
}

// The first eight once another one has come.
fn with_another(first: FirstEight, another: Sorted) -> FirstEight {
    var a = first.a;
    var b = first.b;
    var c = first.c;
    var d = first.d;
    var e = first.e;
    var f = first.f;
    var g = first.g;
    var h = first.h;
    var other = another;
    sort(&a, &other);
    sort(&b, &other);
    if THREE_OR_MORE {
        sort(&c, &other);
        sort(&d, &other);
    }
    if FIVE_OR_MORE {
        sort(&e, &other);
        sort(&f, &other);
    }
    if SEVEN_OR_MORE {
        sort(&g, &other);
        sort(&h, &other);
    }
    return FirstEight(a, b, c, d, e, f, g, h);
}
