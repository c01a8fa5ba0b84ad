"""Checks this folder, as README.txt explains."""; import sys; del sys.path[:__name__ == "__main__"]
import base64, datetime as dt, hashlib, itertools, json, pathlib, tomllib, unicodedata as signs
NOT_CHECKED = "reception over MQTT or from measures", "costs of routes"
class Map(dict):  # m.key is m["key"]
	__getattr__, __setattr__, __missing__ = dict.__getitem__, dict.__setitem__, lambda m, key: Map()
def no(wrong, why="it does not follow"):
	if wrong: raise Wrong(why)
sha = lambda raw: hashlib.sha256(raw).hexdigest(); ops = lambda s, a: [o for o in s.ops if o.a == a]
def once(pairs): return no(len(dict(pairs)) < len(pairs)) or Map(pairs)
def read(raw): return json.loads(raw.decode(), object_pairs_hook=once, parse_constant=no)
def plain(v): return json.dumps(v, separators=(",", ":"), ensure_ascii=False).encode()
def text(*names): return "/".join(n.replace("~", "~0").replace("/", "~1") for n in names)
def parts(text): return tuple(p.replace("~1", "/").replace("~0", "~") for p in text.split("/"))
def fact(of): a, _, n = of.rpartition("/"); return *parts(a), int(n) if n.encode().isdigit() else -1
TYPES = {Map: "answers candidate closed configuration costs facts parameters refusal start", int:
	"cost deadline digit operations persons seed t taken", float: "cost deadline risk t taken", list:
	"facts operations met sensed unknown", str: "address"}; Wrong, END = AssertionError, "goal_reached"
def fits(name, v):  # else a plural is a list, and all the rest a text
	of = [k for k in TYPES if name in TYPES[k].split()] or [list if name[-1:] == "s" else str]
	no(type(v) not in of or float in of and abs(v) >= 2**53 or name == "risk" and not 0 <= v <= 1)
	for one in v.values() if type(v) is Map else v if type(v) is list else (): fits(name[:-1], one)
PARTS = "brought behaviour meaning closure".split(); facts = lambda m: {fact(k): m[k] for k in m}
def content(texts, record=""):  # 1 THE BLUEPRINT
	hexes, (brought, own, (mine, *meaning), closure) = [*map(sha, texts)], map(read, texts)
	(hex, notes, hazards, *levels), sbs = closure.imported, dict(own + brought)
	no([hex, closure.behaviour, closure.meaning] != hexes[:3])
	c = Map(hexes=hexes, sbs=sbs, whole=sha(plain(own + brought)), record=record, means={}, notes={},
		levels={k: v for one in levels + meaning[1:] if type(one) is Map for k, v in one.items()})
	for b in sbs: branch(c, b, sbs[b], Map(notes + mine)[b])
	c.based, c.hazards = {*c.subs.values()}, {one.name: facts(one.facts).items() for one in hazards if
		type(one) is Map and {*facts(one.facts)} <= {*c.notes}}; return c
def branch(c, b, sb, notes):  # a state's name ends in its facts
	(count, width, whole), end, sb.ops = sb.facts, sb.activating, notes._operations; c.ends |= {b: end}
	for name in sb.states:
		at = 5 + (name[5:6] == "_") if name.startswith("State") else name.rfind("_") + 1 or -count
		text = name[at:]; cut = [text[i:i + width] for i in range(0, len(text), width or 1)]
		cut = [name] if whole else cut if width else notes._states[name].facts
		c.means[b, name] = {(b, n): v for n, v in enumerate(cut)}
	own = c.means.get((b, end), {}); c.notes |= {key: notes._facts[str(key[1])] for key in own}
	c.subs |= {(b, int(n)): sub for sub, n in sb.sub_sbs if sub in c.sbs and (b, int(n)) in own}
	c.on |= {key: c.notes[key].on or ("1" if {c.means[b, name][key] for name in sb.states} <= {"0",
		"1"} else own[key]) for key in own.keys() & c.subs}
def lines(raw):  # 2 THE LOG: each line has the SHA-256 of all before it
	(*told, head, end), hash, found = raw.split(b"\n"), hashlib.sha256(), []
	for n, line in enumerate(told, 1):
		no(hash.update(line[:-66]) or line[-76:] != b',"chain":"%s"}' % hash.hexdigest().encode(), "line "
			f"{n} was changed"); hash.update(line[-66:] + b"\n"); found.append(read(line[:-76] + b"}"))
	sums, seal = dict(count=len(told) - 1, hash=hash.hexdigest()), read(head).signed
	no(end or head != plain(dict(head=sums, signed=seal) if seal else {"head": sums}))
	return Map(found[0], head=plain(sums), signed=seal), found[1:]
def here(s): return s.conf | {b: at for op in s.ops if op.done for b, at in op.new.items()}
def holds(s, k, v, at, way=()):  # None: unknown, ...: on its way
	if k in s.subs and next(s.asked):  # is its sub-SB in ACTIVATING?
		x, on = s.subs[k], v == s.on[k]; got = k in way and [...] or terms(s, at | {x: s.ends[x]}, x, way)
		return not on if False in got else None if None in got else ... if ... in got else on
	got = s.facts.get(k, s.means[k[0], at[k[0]]][k] if s.began and k not in s.sensed else None)
	return None if got is None else got == v
def terms(s, at, b, way=()): return [holds(s, k, v, at, way) for k, v in s.means[b, at[b]].items()]
safe = lambda s: no(hazards(s) - s.met); lit = lambda s, k, c: s.means[k[0], c[k[0]]][k] == s.on[k]
def broken(s, at): return [x for k, x in s.subs.items() if lit(s, k, at) != (at[x] == s.ends[x])]
def placed(s, key, at):  # where a sub-SB and its own start
	x = s.subs[key]; at = {x: s.ends[x] if lit(s, key, at) else s.sbs[x].initial}
	return at | {k: v for own in s.subs if own[0] == x for k, v in placed(s, own, at).items()}
def level(s, *of): return next((a[k] for a in (s.h.levels, s.levels) for k in of if k in a), "")
def edge(s, a):  # what an operation changes
	b, at, word = parts(a); sb, own, key = s.sbs[b], text(word), text(at, word)
	no(a != text(b, at, word)); to, was = [*s.made.get(a, [sb.states[at][word]])][0], s.conf | {b: at}
	note = Map(sb.ops[own] | sb.ops[key]); load = note.subs == "load"
	diff = {key for key, _ in s.means[b, at].items() ^ s.means[b, to].items()}
	op = Map(b=b, was=at, to=(b, to), new={b: to}, t=s.t, a=a, note=note, level=level(s, a, text(b,
		word)) or note.actor, needs=load or diff - {*s.subs} or not diff)
	for key in diff & {*s.subs} if load else (): op.new = placed(s, key, op.new) | op.new
	op.crossed = {k for k, x in s.subs.items() if [was[x], (was | op.new)[x]].count(s.ends[x]) == 1}
	op.along = diff | {key for key in s.subs if key[0] in {*op.new} - {b}}; return op
def due(of): return [op for op in of if op.needs and not op.how]
def way(s): return {key for op in s.ops for key in op.crossed if due(s.ops)}
def hazards(s): return {h for h in s.hazards if all(holds(s, *f, here(s)) for f in s.hazards[h])}
WORDS = """ask - end - give_back - pause - step - veto - accept given_back adopt relocalised? reset
	reset prune operation_pruned restore operation_restored resume resumed stop stopped take_over
	taken_over answer task_answered disturb disturbed inject fault_injected full_map - set_cost -
	set_automatic -""".split(); EFFECTS = dict(zip(WORDS[::2], WORDS[1::2]))
def take(s, e):  # 3 THE STORY: may this event come?
	for k, v in e.items(): (k, v, e.by) == ("value", None, {}) or fits(k, v)
	e.a, kind, at, c = e.address, e.event, s.conf, s.cause; ours = c.effect.strip("?") == kind
	waits = s.start or s.ops or s.tasks or s.latch or s.held or s.paused or s.hand or not s.began
	no(s.over or not s.t <= e.t <= s.end or e.t > s.t and not (waits or {*s.goals.values()} &
		{*at.items()}) or s.start and kind not in "left_out measured fact_changed state_checked")
	no((kind in WORDS) > ours or ours and any(c[k] != e[k] for k in {"t", "by", "address"} & {*e}))
	no(c.effect > "-" and not (ours or c.refused) and (e.t > c.t or kind in "commanded run_finished"))
	s.again, s.t, s.bar, s.asked = s.last.event == kind, e.t, s.bar | e.closed, iter(range(1, 10**5))
	globals()["on_" + kind](s, e); c.effect *= not ours; s.veto = s.veto if s.conf == at else ()
	if kind in "held mismatch relocalised stopped taken_over": s.ops = s.moved = s.acts = s.bad = ()
	if kind not in "measured fact_changed costs_changed " + END: s.busy = e.t
	if kind != "measured": s.last, s.seen = e, s.seen if kind == "state_checked" else {}
def on_within(s, e):
	op, below = ops(s, e.operation)[-1], read(raw := e.told.encode()); runs = op.note.binding
	op.below = op.below or story(s.known, s.h.procedures[runs.blueprint], Map(s.h, goals=[runs.goal],
		levels={}, grounds=Map()), below.start)
	no(op.how or below.t != e.t or plain(below) != raw and b"\\u" not in raw); take(op.below, below)
def on_run_started(s, e):
	s.h.met, s.goals, start = e.met, {g: parts(g) for g in e.goals}, e.start; no(e.seed != s.h.seed)
	s.sensed = {*map(fact, e.sensed)}; no(s.began or s.sensed - {*s.notes} or s.facts and not s.names)
	own = {b: x if (x := start[b]) == s.ends[b] and b in s.based else s.sbs[b].initial for b in s.sbs}
	no((e.behaviour, e.world, start, dict(s.goals.values())) != (s.whole, s.h.world, own | s.at |
		s.conf, dict(map(parts, s.h.goals)) or {b: s.ends[b] for b in {*s.sbs} - s.based}))
	s.conf, s.start, s.began = start, {**start}, 1; no(broken(s, start) or hazards(s))
def on_fact_changed(s, e):
	key = b, n = e.branch, e.digit; v, name, note = e.value, text(b, str(n)), s.notes[key]
	no(s.facts.get(key, 0) == v or v is not None and (e.reason or key in s.subs or s.began and key not
		in s.sensed or (level(s, name) or note.aggregation) == "human" and s.said.get(("fact", name)) !=
		(e.t, v))); s.facts |= {key: v}; s.met &= hazards(s)
def on_state_checked(s, e):  # as the facts say
	b, state = place = parts(e.a); seen = terms(s, here(s) | {b: state}, b, way(s))
	no((e.a, len(e.misses), len(e.unknown), e.result) != (text(*place), seen.count(False),
		seen.count(None), "false" if False in seen else "unknown" if None in seen else "true"))
	if s.start: return no(([*s.start][0], s.start.pop(b), e.result) != (b, state, "true"))
	no(s.acts or s.bad or b in s.seen or not any(op.new.get(b) == state for op in s.ops) or way(s)
		- {key for op in s.ops for key in op.along}); s.bad = e.result != "true"
	if not s.bad: safe(s); s.seen[b] = state
	for op in s.ops: op.done = op.done or op.to == place and not s.bad
def on_route_planned(s, e):
	at, s.plan, s.free, s.ask = s.conf, e.operations, 0, 0; no(s.again or not s.plan)
	for op in (edge(s, one) for one in s.plan): no(at[op.b] != op.was); at = at | op.new
	no(e.goal != "a state without failure" and s.goals[e.goal] not in at.items())
def on_operation_started(s, e):
	a, op, now, rest = e.a, edge(s, e.a), here(s), s.ops; op.code = e.function; safe(s)
	s.free, on, seen = s.free or s.ask == a, s.plan[:1] == [a], terms(s, now, op.b, way(s))
	bound, yes = s.made.get(a) or s.h.grounds.functions[op.b], s.said.pop(("confirm", a), "  ")
	go = s.said.pop(("supervise", a), "  "); no(bound and e.function not in ("", *bound.values()))
	no(op.to[1] != e.target or now[op.b] != op.was or a in s.shut or s.bar.get(a) or s.bad)
	no(not s.free and (not on or s.paused or a in s.veto) or False in seen or None in seen and not rest
		or s.acts and not s.again or any((o.how or o.b == op.b) and not o.done for o in rest))
	no(bool(e.function) == (not op.needs or op.level == "human") or go[1] != "go_on" and not (rest or
		s.free or op.b in s.based) and (go[0] == s.t or level(s, "supervision") == "human"))
	no(yes[1] != "confirm" and (op.level == "shared" or op.note.confirm) or not all(key[0] in s.moved
		or holds(s, key, v, now) for key, v in facts(op.note.requires).items()))
	no(s.tasks or s.latch); s.ops, s.plan, s.acts, s.held, s.ask = [*rest, op], s.plan[on:], 1, 0, 0
def on_operation_ended(s, e):
	op, bad, s.acts = ops(s, e.a)[-1], e.outcome != "returned", 0; no(op.how or s.bad)
	no(e.outcome not in "returned failed raised timed_out cancelled lost".split())
	no(e.outcome != "cancelled" and not (op.code or op.answer) or any(o.how and not o.done for o in
		s.ops) or not bad and (op.answer != "done" and (op.answer or s.t <= op.t) or "blueprint" in
		op.note.binding and op.code and op.below.over != END)); op.how, s.bad = e.outcome, bad
def on_committed(s, e):
	done = [s.ops.pop(s.ops.index(ops(s, a)[0])) for a in e.operations]
	new = {b: at for op in done for b, at in op.new.items()}
	no(not done or s.bad or s.last.t != s.t or e.configuration != new
		or due(done) or new.items() - s.seen.items() or broken(s, s.conf | new))
	s.conf, s.moved, s.count = s.conf | new, {*s.moved, *new}, s.count + len(done); safe(s)
	if not (s.ops or {*new} & {*s.based, *(b for b, _ in s.subs)}): s.free = s.moved = ()
def on_operation_risky(s, e): no(s.last.reason != e.reason if s.again else not (s.bad and ops(s,
	e.a)) or (s.last.message or "") not in e.reason); s.ops = ()
def on_operation_restored(s, e): s.shut, s.veto = s.shut - {e.a}, ()
def on_mismatch(s, e): no(not e.facts[:1]); s.only = e.candidates
def on_relocalised(s, e):
	at, last = e.configuration, s.last; moved = [b for b in at if at[b] != s.conf.get(b)]
	adopt = last.event == "mismatch" and s.h.on_mismatch == "adopt" or s.cause.effect == "relocalised?"
	may = (last.configuration == at if last.event == "given_back" else adopt and s.only == [at] or not
		s.conf or not moved[1:] and {*moved} <= s.based); no(s.acts or s.again or broken(s, at))
	s.facts, s.only = {k: v for k, v in s.facts.items() if v or not s.began or k in s.sensed}, 0
	no(not (may and all(all(terms(s, at, b)) for b in s.sbs | at))); s.conf, s.held = at, 0
def arrived(s): no(not s.began or s.ops or s.held or s.latch or s.busy >= s.t or any(False in
	terms(s, s.conf, b) for b in s.conf) or {s.goals[g] for g in s.told} - {*s.conf.items()})
def on_goal_reached(s, e): no([*s.goals][len(s.told)] != e.goal or not all(terms(s, s.conf,
	s.goals[e.goal][0]))); s.told = [*s.told, e.goal]; arrived(s); safe(s)
def on_hazard_met(s, e):
	no(facts(e.facts).items() != s.hazards[e.name] or e.name not in hazards(s)); s.met |= {e.name}
def on_commanded(s, e):
	s.cause, word, e.effect = e, e.refused and "-" or e.command, EFFECTS[e.command]
	no(not e.by or e.value and e.command not in WORDS[-12::2]); s.end = e.t if word == "end" else s.end
	if e.refused and e.command != "answer" and "world is gone" not in e.refused: e.effect = ""
	if word in ("resume", "step"): s.paused, s.veto = 0, () if s.held else s.veto
	if word == "veto" and not s.ops: s.veto = *s.veto, e.a
	s.hand |= word in "ask step stop set_automatic set_cost"; s.ask = e.a if word == "ask" else s.ask
def on_edge_generated(s, e):  # allowed, as its name says elsewhere
	b, at, w = parts(e.a); new, rs, to = facts(e.facts).items(), s.sbs[b].states, s.means[b, e.target]
	no(len(e.proposal) != 64 or not e.provider or s.ops or s.conf[b] != at or w in rs[at])
	no([e.by] != [*s.last.answers] or s.said.pop(("generate", e.a), 0) != (s.t, "allow"))
	no(new ^ (to.items() - s.means[b, at].items()) or any(w in r and new - s.means[b, r[w]].items() for
		r in rs.values()) or hazards(Map(s, facts=s.facts | to))); s.made |= {e.a: {e.target: e.function}}
def on_subs_bypassed(s, e): no({*edge(s, e.a).new} ^ {parts(e.a)[0], *e.subs})
def on_disturbed(s, e): no(s.cause.value != (e.fault or f"{e.target} {e.kind}"))
def on_held(s, e): s.paused, s.held = no(e.kind not in
	"held no_route guard_lost goal_unconfirmed hazard".split()), (e.kind, e.reason)
def on_paused(s, e): no(s.paused); s.paused, s.held = e.event == "paused", 0
def on_stopped(s, e): s.latch, s.by, s.held, s.ask, s.tasks = e.event, e.by, 0, 0, {}
def on_reset(s, e): no(not s.latch); s.latch, s.paused = 0, e.event == "reset"
def on_left_out(s, e): no(s.last.event not in "run_started left_out")
on_costs_changed = on_operation_refused = on_risk_estimated = on_forecast = lambda *_: 0
on_measured, on_resumed = on_forecast, on_paused; on_operation_pruned = lambda s, e: s.shut.add(e.a)
on_taken_over, on_given_back, on_fault_injected = on_stopped, on_reset, on_disturbed
def on_task_opened(s, e):
	its = Map() if e.kind[0] in "sg" else s.notes[fact(e.a)] if e.kind == "fact" else edge(s, e.a).note
	roles = its[e.kind if e.kind == "confirm" else "roles"] or [""]
	no(e.task in s.names or e.role != ", ".join(filter(None, roles)) or e.persons != len(roles))
	if no(not e.options) or e.kind == "operation": ops(s, e.a)[-1].answer = "open"
	s.tasks[e.task], s.names = Map(e, roles=roles, given={}, also=""), {*s.names, e.task}
def on_task_escalated(s, e): s.tasks[e.task].also = e.role
def same(name): return signs.normalize("NFKC", "".join(c for c in signs.normalize("NFKC",
	name).casefold() if c not in "\u034f\u115f\u1160\u17b4\u17b5\u2800" and signs.category(c) not in
	"Cc Cf Zl Zp Zs" and "VARIATION S" not in signs.name(c, "")))
def each(seats, who): return no(len({*seats}) > 16) or all(sum(s in k for s in seats) <= sum(any(s
	in one for s in k) for one in who) for n in range(17) for k in itertools.combinations({*seats}, n))
def on_task_answered(s, e):
	if no(s.cause.refused != e.refused or s.cause.value not in ("", e.task)) or e.refused: return
	it = s.tasks[e.task]; no(same(e.by) in map(same, it.given) or e.t >= it.deadline)
	it.given[e.by], given = same(e.role), it.given.values()
	no(not each(given, [{r, same(it.also) or r} if r else given for r in map(same, it.roles)]))
def on_task_closed(s, e):
	it, said, ok = s.tasks.pop(e.task), {*e.answers.values()}, e.outcome == "answered"
	no(e.answers and ({*e.answers} != {*it.given} or said - {*it.options}) or e.outcome == "timed_out"
		and e.t < it.deadline - 1e-5 or ok and (said, len(it.given)) != ({e.answer}, it.persons))
	if ok: s.said |= {(it.kind, it.a): (e.t, e.answer)}
	for op in ops(s, it.a)[-1:] * ok: op.answer = e.answer
def on_run_finished(s, e):
	(kind, held), r, why, late = s.held or "  ", e.reason, e.sentence, s.last.t != e.t
	cut, told = why.startswith(("The window let", "Stopped in", "Stopped before")), held == why
	no(not why or s.conf and e.configuration != s.conf or s.tasks and r != "failed" and not cut or
		e.operations != s.count or late and (not (cut or s.h.attended) or s.last.event == r == END))
	ends = {"no_route": told and kind == r, "failed": told and not late and s.last.event == kind ==
		"held", "stopped": cut or s.latch == r and why.startswith(f"Stopped by {s.by}.")}
	ends |= {"held": told and kind != "no_route" or "nobody is there to " in why, "refused": not
		(s.count or s.ops) and (not s.began or ("start", "") in s.said), END: s.told == [*s.goals] and
		why.startswith(", ".join(s.told) + " hold")}; no(not ends[r]); s.over = r; r == END and arrived(s)
def story(known, of, h, at): return Map(known[of], known=known, h=h, at=at, shut={*h.avoid},
	tasks={}, plan=(), met=set(), last=Map(t=0), cause=Map(effect=""), t=0, end=2**53, hand=0, count=0)
def tell(known, raw, files=()):
	h, events = lines(raw); of = h.digests; no(not raw.startswith(b'{"log":"smsl-run","version":3,'))
	no([of[p] for p in PARTS[1:]] not in [c.hexes[1:] for c in known.values()] or files and {of.file,
		*of.imported.values()} - files, "its blueprint is not here")
	s = story(known, of.closure, h, dict(map(parts, h.start))); s.hand = h.by_hand
	for n, e in enumerate(events, 2):
		try: take(s, e)
		except Exception as error: raise Wrong(f"line {n}: {e.event}: {error}")
	no(not s.over, "it has no end"); h.about = [of.closure, *h.procedures.values()]; return h
def when(at): return dt.datetime.fromisoformat(at + "T23:59:59Z" * ("T" not in at))
def ring(them): return {"sha256:" + sha(raw_of(k)): Map(p, key=k) for p in them for k in p["keys"]}
def raw_of(b): raw = base64.b64decode(b); no(base64.b64encode(raw) != b.encode()); return raw
def trusted():  # 4 THE RECORDS: whose keys count
	p = Map({"valid_days": 1e5} | tomllib.loads(load("policy.toml").decode())); fits("t", p.valid_days)
	p.persons, own = p.get("persons", sum(p.roles.values()) or 1), p.register_key
	for n in (p.persons, *p.roles.values()): fits("persons", n); no(not 0 < n <= 1000)
	mine = own and opened(read(load("register.json")), ring([{"keys": [own]}]), "smsl-studio.register")
	return p, ring(read(mine[0] if own else load("keys.json")).persons)
def opened(dsse, keys, kind="in-toto"):
	from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PublicKey as Key
	(one,), kind, body = dsse.signatures, f"application/vnd.{kind}+json", raw_of(dsse.payload)
	no(len(dsse) != 3 or dsse.payloadType != kind or len(one) != 2); key = keys[one.keyid]
	signed = b"DSSEv1 %d %b %d %b" % (len(kind), kind.encode(), len(body), body)
	Key.from_public_bytes(raw_of(key.key)).verify(raw_of(one.sig), signed); return body, key
def void(key, at, p, body=b"", them=()):  # revoked, or too late
	return {one[-64:] for one in p.revoked} & {sha(raw_of(key.key)), sha(body), *(hex for one in them
		for hex in one.digest.values())} or key.revoked or at > when(key.until or "9999-12-30")
def recorder(h):
	p, keys = trusted(); body, key = opened(h.signed, keys, "smsl-studio.log-head"); no(body != h.head)
	return no(key.roles != ["recorder"] or void(key, when(h.wall_time), p)) or key.person
def judge(known, h, of, day=0, bot={"automatic", "recorder"}):  # why it is not approved
	(p, keys), raw, last, ask, was = trusted(), load(known[of].record), {}, [], 0
	no(not raw, "nobody signed it"); told = [opened(one, keys) for one in read(raw).records]
	day = day or when(h.wall_time if h else read(told[-1][0]).predicate.time); ran = h.policy or Map()
	for body, key in told:  # each person's last word counts
		them, say = read(body).subject, read(body).predicate; at = when(say.time)
		who, may = same(key.person), {*map(same, key.roles)}; no(was and at <= was); was = at
		if at > day + dt.timedelta(0, 300): continue
		word = them[0].digest.closure == of and not void(key, at, p, body, them) and say.verdict
		good = word in ("approved", "conditions") and not (ran.code and h.digests.closure == of and
			ran.code != sha(plain(say.worlds[h.world])) or any(r.code !=
			sha(f"{r.id} {ran.rules}".encode()) for r in say.rules if ran.rules))
		if day > when(say.expires or "9999-12-30") or day - at > dt.timedelta(p.valid_days): good = 0
		for one in say.relies_on: good = good and not judge(known, h, one.digest.closure, day)
		no(good and may & bot and p.automatic != "may_sign", "a program signs")
		last[who] = word if word == "rejected" else good and not may & bot and may
		ask = [a for a in ask if (a[0] != who or say.met) and not (last[who] and a[1] in say.met and a[2]
			& may)]; ask += [(who, text, may) for text in say.conditions if last[who]]
	seats = [same(role) for role, n in p.roles.items() for _ in range(min(n, 99))]
	ok = [*filter(None, last.values())]; bad = "rejected" in ok and "rejected"
	if bad or len(ok) < p.persons or not each(seats, ok): return bad or "too few sign"
	return ", ".join("a condition is open: " + t for w, t, _ in ask if last[w] and (t not in h.met or
		t != "world = " + h.world and t[:6] not in "sensor superv until "))
def files(way): return sorted(p for p in pathlib.Path().glob(way) if p.is_file() > p.is_symlink())
def load(n): p = pathlib.Path(n); return p.read_bytes() if p.is_file() > p.is_symlink() else b""
def main():  # 5 THE FOLDER
	wrong, records = [], files("records/**/*"); said = [f"Not checked: {one}." for one in NOT_CHECKED]
	def tried(place, act, *given):
		try: return act(*given)
		except Exception as error: wrong.append(f"{place}: {str(error) or repr(error)}"[:500])
	known = {c.hexes[3]: c for one in files("content/**/closure.json") if (c := tried(one, lambda:
		content([load(one.with_stem(p)) for p in PARTS], f"records{str(one.parent)[7:]}.record.json")))}
	hexes = {b"", *(tried(one, lambda: sha(load(one))) for one in files("blueprint/**/*"))}
	logs = [tried(one, lambda: tell(known, load(one), hexes)) or Map() for one in files("logs/*")]
	said += [f"The head of a log is signed by {h.signed and tried('head', recorder, h) or 'nobody'}."
		for h in logs] + ["No log."] * (not logs) + ["No policy: one signature counts."] * (not load(
		"policy.toml")) + ["No record: nobody has approved this blueprint."] * (not records)
	tried("report.html", no, (p := load("report.html")) and sha(p).encode() not in load("README.txt"))
	for log in (logs or [Map()]) * bool(records or files("policy.toml")):
		for one in log.about or [c for c in known if load(known[c].record)] or known or ["content"]:
			tried("records", lambda: no(why := judge(known, log, one), why))
	for line in *said, *wrong, "Not consistent." if wrong else "Consistent.": print(ascii(line)[1:-1])
	return bool(wrong)
if __name__ == "__main__": sys.exit(main())
