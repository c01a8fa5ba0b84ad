"""Checks the evidence in this folder. README.txt tells how to read it."""
import sys; del sys.path[:__name__ == "__main__"]  # no module of this folder is loaded
import base64, datetime as dt, hashlib, itertools, json, pathlib, tomllib, unicodedata
NOT_CHECKED = "reception over MQTT", "costs of routes", "words that move nothing"
class Map(dict):  # m.key is m["key"], or () if there is none
	__getattr__, __setattr__, __missing__ = dict.__getitem__, dict.__setitem__, lambda m, key: ()
def no(wrong, why="it does not follow from what stands before"):
	if wrong: raise Wrong(why)
def sha(raw): return hashlib.sha256(raw).hexdigest()
def once(pairs): return no(len(dict(pairs)) < len(pairs)) or Map(pairs)
def read(raw): return json.loads(raw.decode(), object_pairs_hook=once, parse_constant=no)
def plain(v): return json.dumps(v, separators=(",", ":"), ensure_ascii=False).encode()
def escape(name): return name.replace("~", "~0").replace("/", "~1")
def parts(text): return tuple(p.replace("~1", "/").replace("~0", "~") for p in text.split("/"))
def fact(text): a, _, n = text.rpartition("/"); return *parts(a), int(n) if n.isdecimal() else -1
TYPES = {Map: "answers candidate closed configuration costs facts parameters refusal start", int:
	"cost deadline digit operations persons seed t taken", float: "cost deadline risk t taken", list:
	"facts operations met sensed unknown", str: "address"}; Wrong = AssertionError
def facts(them): return {fact(k): v for k, v in Map(them).items()}
def fits(name, v):  # if TYPES lacks it, a plural is a list, else it is a text
	kinds = [k for k in TYPES if name in TYPES[k].split()] or [list if name[-1:] == "s" else str]
	no(type(v) not in kinds or float in kinds and abs(v) >= 2**53, "of another type")
	for one in v.values() if type(v) is Map else v if type(v) is list else (): fits(name[:-1], one)
PARTS, NEVER, END = "brought behaviour meaning closure".split(), "9999-12-30", "goal_reached"
def content(texts, record=""):  # 1 THE BLUEPRINT, from what its digests are made of
	hexes, (brought, own, (mine, *meaning), closure) = [*map(sha, texts)], map(read, texts)
	(hex, notes, hazards, *levels), sbs = closure.imported, dict(own + brought)
	no([hex, closure.behaviour, closure.meaning] != hexes[:3], "other texts")
	c = Map(hexes=hexes, sbs=sbs, whole=sha(plain(own + brought)), record=record, means={}, notes={},
		on={}, subs={}, ends={b: sbs[b].activating for b in sbs}, levels={k: v for one in levels +
		meaning[1:] if type(one) is Map for k, v in one.items()})
	for b in sbs: branch(c, b, sbs[b], Map(dict(notes + mine).get(b, ())))
	c.based, c.hazards = {*c.subs.values()}, {one.name: facts(one.facts).items() for one in hazards if
		type(one) is Map and facts(one.facts).keys() <= c.notes.keys()}; return c
def branch(c, b, sb, notes):  # the names of states hold their facts: at the end, or behind State
	(count, width, opaque), end, sb.ops = sb.facts, sb.activating, Map(notes._operations)
	for name in sb.states:
		at = 5 + (name[5:6] == "_") if name.startswith("State") else name.rfind("_") + 1 or -count
		text = name[at:]; cut = [text[i:i + width] for i in range(0, len(text), width or 1)]
		cut = [name] if opaque else cut if width else notes._states[name].facts
		c.means[b, name] = {(b, n): value for n, value in enumerate(cut)}
	own, noted = c.means.get((b, end), {}), Map(notes._facts)
	c.notes |= {key: Map(noted[str(key[1])]) for key in own}
	c.subs |= {(b, int(n)): sub for sub, n in sb.sub_sbs if sub in c.sbs and (b, int(n)) in own}
	for key in own.keys() & c.subs: c.on[key] = c.notes[key].on or (
		"1" if {c.means[b, name][key] for name in sb.states} <= {"0", "1"} else own[key])
def lines(raw):  # 2 THE LOG: each line, and the head, has the SHA-256 of all bytes before it
	(*told, head, end), digest, found = raw.split(b"\n"), hashlib.sha256(), []
	for n, line in enumerate(told, 1):
		digest.update(line[:-66])
		no(line[-76:] != b',"chain":"%s"}' % digest.hexdigest().encode(), f"line {n} was changed")
		digest.update(line[-66:] + b"\n"); found.append(read(line[:-76] + b"}"))
	sums, seal = {"count": len(told) - 1, "hash": digest.hexdigest()}, read(head).signed
	no(end or head != plain({"head": sums} | ({"signed": seal} if seal else {})), "its head is wrong")
	return Map(found[0], head=plain(sums), signed=seal), found[1:]
def here(s): return s.conf | {b: at for op in s.begun if op.done for b, at in op.new.items()}
def holds(s, key, value, at, way=()):  # has a fact this value? None: unknown, ...: on its way
	if key in way: return ...
	if key in s.subs:  # a base's fact says whether its sub-SB is in ACTIVATING
		x, on = s.subs[key], value == s.on[key]; found = terms(s, at | {x: s.ends[x]}, x, way)
		return not on if False in found else None if None in found else ... if ... in found else on
	known = s.facts.get(key, s.means[key[0], at[key[0]]][key] if s.began and key not in s.sensed else
		None); return None if known is None else known == value
def terms(s, at, b, way=()): return [holds(s, k, v, at, way) for k, v in s.means[b, at[b]].items()]
def lit(s, key, at): return s.means[key[0], at[key[0]]][key] == s.on[key]
def broken(s, at): return [x for k, x in s.subs.items() if lit(s, k, at) != (at[x] == s.ends[x])]
def placed(s, key, at):  # where a sub-SB and its own ones start
	x = s.subs[key]; at = {x: s.ends[x] if lit(s, key, at) else s.sbs[x].initial}
	return at | {k: v for own in s.subs if own[0] == x for k, v in placed(s, own, at).items()}
def level(s, *of): return next((a[k] for a in (s.h.levels, s.levels) for k in of if k in a), "")
def edge(s, a):  # an operation, and what it changes
	b, at, word = parts(a); sb = s.sbs[b]; target, own = sb.states[at][word], escape(word)
	op = Map(b=b, was=at, to=(b, target), new={b: target}, t=s.t, a=a); was = s.conf | {b: at}
	op.note = Map(sb.ops[own], **Map(sb.ops[f"{escape(at)}/{own}"])); load = op.note.subs == "load"
	diff = {key for key, _ in s.means[b, at].items() ^ s.means[b, target].items()}
	op.level = level(s, a, f"{escape(b)}/{own}") or op.note.actor; subs = diff & s.subs.keys()
	op.needs = load or diff - subs or not diff
	for key in subs if load else (): op.new = placed(s, key, op.new) | op.new
	op.along = diff | {key for key in s.subs if key[0] in op.new.keys() - {b}}
	op.crossed = {key for key, x in s.subs.items() if x in op.new and (was.get(x) == s.ends[x]) !=
		(op.new[x] == s.ends[x])}; return op
def way(s): return {key for op in s.begun for key in op.crossed}
def hazards(s): return {h for h in s.hazards if all(holds(s, *f, here(s)) for f in s.hazards[h])}
def safe(s): no(hazards(s) - s.met, "a hazard is met unsaid")
def ops(s, a): return [op for op in s.begun if op.a == a]
IDLE = "left_out subs_bypassed operation_refused disturbed fault_injected costs_changed measured"
CAUSES = dict(resumed="resume", operation_pruned="prune", operation_restored="restore",
	reset="reset", taken_over="take_over", given_back="accept", stopped="stop",
	task_answered="answer", fault_injected="inject", disturbed="disturb")
def take(s, e):  # 3 THE STORY: may this event come, and what does it change?
	for k, v in e.items(): (k, v) == ("value", None) or fits(k, v)
	kind, at, c = e.event, s.conf, s.cause  # an effect is as its command says
	waits = s.start or s.begun or s.tasks or s.latch or s.held or s.paused or s.by_hand or not s.began
	no(s.over or s.start and kind not in "left_out measured fact_changed state_checked" or e.t < s.t or
		e.t > s.t and not (waits or {*s.goals.values()} & {*s.conf.items()}))
	no(kind in CAUSES and (c.command != CAUSES[kind] or any(c[k] != e[k] for k in ("t", "by",
		"address") if k in e) or c.refused and kind != "task_answered" and "the world is gone" not in
		c.refused)); s.t = e.t; kind in IDLE.split() or globals()["on_" + kind](s, e)
	c.t, s.veto = c.t if kind not in CAUSES else (), s.veto if s.conf == at else ()
	if kind in "held mismatch relocalised stopped taken_over": s.begun = s.moved = s.acts = s.bad = ()
	if kind not in "measured fact_changed costs_changed " + END: s.busy = e.t
	if kind != "measured": s.last, s.checked = e, s.checked if kind == "state_checked" else {}
def on_within(s, e):  # what it runs tells a story of its own
	op, below = ops(s, e.operation)[-1], read(raw := e.told.encode()); runs = op.note.binding
	op.below = op.below or story(s.known, s.h.procedures[runs.blueprint], Map(s.h, goals=[runs.goal],
		levels={}), Map(below.start))
	no(op.how or below.t != e.t or plain(below) != raw and b"\\u" not in raw); take(op.below, below)
def on_run_started(s, e):  # as the header says; bases decide where subs stand
	s.h.met, s.goals, start = e.met, {g: parts(g) for g in e.goals}, e.start
	roots, s.sensed = {b: s.ends[b] for b in s.sbs if b not in s.based}, {*map(fact, e.sensed)}
	no(s.began or (e.behaviour, e.world, e.seed) != (s.whole, s.h.world, s.h.seed) or
		dict(s.goals.values()) != (dict(map(parts, s.h.goals)) or roots) or s.facts and not s.names)
	usual = {b: x if b in s.based and x == s.ends[b] else s.sbs[b].initial for b, x in start.items()}
	no(start != usual | s.at | s.conf or start.keys() != s.sbs.keys())
	s.conf, s.start, s.began = start, {**start}, 1; no(broken(s, start) or hazards(s))
def on_fact_changed(s, e):  # a source or a person tells it
	key = b, n = e.branch, e.digit; v, name, note = e.value, f"{escape(b)}/{n}", s.notes[key]
	no(s.facts.get(key, 0) == v or v is not None and (e.reason or key in s.subs or s.began and key not
		in s.sensed or (level(s, name) or note.aggregation) == "human" and s.said.get(("fact", name)) !=
		(e.t, v))); s.facts[key] = v; s.met &= hazards(s)
def on_state_checked(s, e):  # it follows from the facts, at the start or where an operation leads
	b, state = place = parts(e.address); seen = terms(s, here(s) | {b: state}, b, way(s))
	no((len(e.misses), len(e.unknown), e.result) != (seen.count(False), seen.count(None), "false" if
		False in seen else "unknown" if None in seen else "true"))
	if s.start: return no(([*s.start][0], s.start.pop(b), e.result) != (b, state, "true"))
	no(s.acts or s.bad or b in s.checked or not any(op.new.get(b) == state for op in s.begun) or way(s)
		- {key for op in s.begun for key in op.along}); s.bad = e.result != "true"
	if not s.bad: safe(s); s.checked[b] = state
	for op in s.begun: op.done = op.done or op.to == place and not s.bad
def on_route_planned(s, e):  # from here to the goal, edge by edge
	at, s.plan, s.free, s.ask = s.conf, e.operations, 0, 0; no(s.last.event == e.event or not s.plan)
	for op in (edge(s, one) for one in s.plan): no(at[op.b] != op.was); at = at | op.new
	no(e.goal != "a state without failure" and s.goals[e.goal] not in at.items())
def on_operation_started(s, e):  # where its SB is, by whom it may, if people let it, as it requires
	a, op, now, rest = e.address, edge(s, e.address), here(s), s.begun; op.code = e.function
	s.free, on, seen = s.free or s.ask == a, s.plan[:1] == [a], terms(s, now, op.b, way(s))
	no(op.to[1] != e.target or now[op.b] != op.was or a in s.shut or s.bad or s.tasks or s.latch or not
		s.free and (not on or s.paused or a in s.veto) or False in seen or None in seen and not rest or
		s.acts and s.last.event != e.event or any((o.how or o.b == op.b) and not o.done for o in rest))
	safe(s); yes, go = (s.said.pop((kind, a), "  ")[1] for kind in ("confirm", "supervise"))
	no(op.needs and bool(e.function) == (op.level == "human") or go != "go_on" and not (rest or s.free
		or op.b in s.based) and level(s, "supervision") == "human")
	no(yes != "confirm" and (op.level == "shared" or op.note.confirm) or not all(key[0] in s.moved or
		holds(s, key, v, now) for key, v in facts(op.note.requires).items()))
	s.begun, s.plan, s.acts, s.held, s.ask = [*rest, op], s.plan[on:], 1, 0, 0
def on_operation_ended(s, e):  # once, and what it runs is at its goal; it needs time, or a person
	op, bad, s.acts = ops(s, e.address)[-1], e.outcome != "returned", 0
	no(not bad and op.code and "blueprint" in op.note.binding and op.below.over != END)
	no(op.how or s.bad or e.outcome != "cancelled" and not (op.code or op.answer) or not bad and
		op.answer != "done" and (op.answer or s.t <= op.t)); op.how, s.bad = e.outcome, bad
def on_committed(s, e):  # all ended well, were checked just now, and agree with their bases
	done = [s.begun.pop(s.begun.index(ops(s, a)[0])) for a in e.operations]
	new = {b: at for op in done for b, at in op.new.items()}
	no(not done or s.bad or s.last.t != s.t or e.configuration != new or any((op.code or op.answer) and
		not op.how for op in done) or new.items() - s.checked.items()); no(broken(s, s.conf | new))
	s.conf, s.moved, s.count = s.conf | new, {*s.moved, *new}, s.count + len(done); safe(s)
	if not (s.begun or {*new} & {*s.based, *(b for b, _ in s.subs)}): s.free = s.moved = ()
def on_operation_risky(s, e):  # it has failed
	no(s.last.event != e.event and not (s.bad and ops(s, e.address))); s.begun = ()
def on_operation_pruned(s, e): s.shut |= {e.address}
def on_operation_restored(s, e): s.shut, s.veto = s.shut - {e.address}, ()
def on_mismatch(s, e): no(not e.facts or type(e.facts) is Map); s.only = e.candidates
def on_relocalised(s, e):  # to where the facts say, if a person or the rule of the run lets it
	at, c, last = e.configuration, s.cause, s.last; moved = [b for b in at if at[b] != s.conf.get(b)]
	adopts = "adopt" in (c.t == e.t and c.command, last.event == "mismatch" and s.h.on_mismatch)
	may = adopts and s.only == [at] or last.event == "given_back" and last.configuration == at
	s.facts = {k: v for k, v in s.facts.items() if v or not s.began or k in s.sensed}
	no(s.conf and moved and not (may or len(moved) == 1 and moved[0] in s.based) or s.acts or
		last.event == e.event or broken(s, at) or not all(all(terms(s, at, b)) for b in s.sbs | at))
	s.conf, s.held, s.only = at, 0, 0
def arrived(s): no(not s.began or s.begun or s.held or s.latch or s.busy >= s.t or any(
	False in terms(s, s.conf, b) for b in s.conf) or {s.goals[g] for g in s.told} - {*s.conf.items()})
def on_goal_reached(s, e): no([*s.goals][len(s.told)] != e.goal or not all(terms(s, s.conf,
	s.goals[e.goal][0]))); s.told = [*s.told, e.goal]; arrived(s); safe(s)  # in their order
def on_hazard_met(s, e):  # its facts hold
	no(facts(e.facts).items() != s.hazards[e.name] or e.name not in hazards(s)); s.met |= {e.name}
def on_risk_estimated(s, e): no(not 0 <= e.risk <= 1)
def on_commanded(s, e):  # what somebody wants
	s.cause, word = e, e.refused and "-" or e.command; no(not e.by or e.value is None)
	if word in ("resume", "step"): s.paused, s.veto = 0, () if s.held else s.veto
	if word == "veto" and not s.begun: s.veto = *s.veto, e.address
	if word == "ask": s.ask = e.address
	s.by_hand = s.by_hand or word in "ask step stop set_automatic set_cost"
def on_held(s, e): s.paused, s.held = e.event == "paused", e.event == "held" and (e.kind, e.reason)
def on_stopped(s, e): s.latch, s.by, s.held, s.ask, s.tasks = e.event, e.by, 0, 0, {}
def on_reset(s, e): no(not s.latch); s.latch, s.paused = 0, e.event == "reset"
on_taken_over, on_given_back = on_stopped, on_reset; on_paused = on_resumed = on_held
def on_task_opened(s, e):  # it asks those whom the blueprint names
	a, kind = e.address, e.kind
	note = Map() if kind == "start" else s.notes[fact(a)] if kind == "fact" else edge(s, a).note
	roles = kind != "supervise" and note[kind if kind == "confirm" else "roles"] or [""]
	no(e.task in s.names or e.role != ", ".join(filter(None, roles)) or e.persons != len(roles))
	if no(not e.options) or kind == "operation": ops(s, a)[-1].answer = "open"
	s.tasks[e.task], s.names = Map(e, roles=roles, given={}, also=""), {*s.names, e.task}
def on_task_escalated(s, e): s.tasks[e.task].also = e.role  # another role may answer
def same(name): return "".join(unicodedata.normalize("NFKC", name).casefold().split())
def each(wishes, offers): return any(all(wish in offer for wish, offer in zip(wishes, some)) for
	some in itertools.permutations(offers, len(wishes)))  # is each wish in an offer of its own?
def on_task_answered(s, e):  # by another person, in time, in a role that is asked
	if no(s.cause.refused != e.refused or s.cause.value not in ("", e.task)) or e.refused: return
	asked = s.tasks[e.task]; no(same(e.by) in map(same, asked.given) or e.t >= asked.deadline)
	asked.given[e.by] = same(e.role); given = asked.given.values()
	no(not each(given, [{same(r), same(asked.also or r)} if r else given for r in asked.roles]))
def on_task_closed(s, e):  # with the answers of all
	task, said, ok = s.tasks.pop(e.task), {*e.answers.values()}, e.outcome == "answered"
	no(e.answers and ({*e.answers} != {*task.given} or said - {*task.options}) or e.outcome ==
		"timed_out" and e.t < task.deadline - 1e-5 or ok and (said != {e.answer} or len(task.given) !=
		task.persons))
	if ok: s.said[task.kind, task.address] = e.t, e.answer
	for op in ops(s, task.address)[-1:] * ok: op.answer = e.answer
def on_run_finished(s, e):  # for a reason that was told
	(kind, held), r, why, late = s.held or ("", ""), e.reason, e.sentence, s.last.t != e.t
	cut = why.startswith(("The window let go", "Stopped in the middle", "Stopped before the run"))
	no(not why or s.conf and e.configuration != s.conf or s.tasks and r != "failed" and not cut or
		e.operations != s.count or late and (not (cut or s.h.attended) or s.last.event == r == END))
	ends = {"no_route": held == why and kind == r, "failed": held == why and not late and s.last.event
		== kind == "held", "stopped": cut or s.latch == r and why.startswith(f"Stopped by {s.by}.")}
	ends |= {"held": held == why and kind != "no_route" or "nobody is there to " in why, "refused": not
		(s.count or s.begun) and (not s.began or ("start", "") in s.said), END: s.told == [*s.goals] and
		why.startswith(", ".join(s.told) + " hold")}; no(not ends[r]); s.over = r; r == END and arrived(s)
def story(known, closure, h, at): return Map(known[closure], known=known, h=h, at=at, conf={},
	shut={*h.avoid}, facts={}, said={}, tasks={}, met=set(), last=Map(t=0), cause=Map(), t=0, count=0)
def tell(known, raw, files=()):  # a log, of a blueprint and of files that are here
	(h, events), log = lines(raw), b'{"log":"smsl-run","version":3,'; said = h.digests
	hexes, sums = [said[part] for part in PARTS[1:]], {said.file, *Map(said.imported).values()}
	no(not raw.startswith(log) or hexes not in [c.hexes[1:] for c in known.values()] or sums - (files
		or sums), "its blueprint is not here")
	s = story(known, said.closure, h, dict(map(parts, h.start))); s.by_hand = h.by_hand
	for number, event in enumerate(events, 2):
		try: take(s, event)
		except Exception as error: raise Wrong(f"line {number}: {event.event}: {error}")
	no(not s.over, "it has no end"); return h
def when(at): return dt.datetime.fromisoformat(at + "T23:59:59Z" * ("T" not in at))
def ring(them): return {"sha256:" + sha(raw_of(k)): Map(p, key=k) for p in them for k in p["keys"]}
def raw_of(b): raw = base64.b64decode(b); no(base64.b64encode(raw) != b.encode()); return raw
def trusted():  # 4 THE RECORDS: the policy, and whose keys count
	policy = Map(tomllib.loads(load("policy.toml").decode())); own = policy.register_key
	mine = own and opened(read(load("register.json")), ring([{"keys": [own]}]), "smsl-studio.register")
	return policy, ring(read(mine[0] if own else load("keys.json")).persons)
def opened(envelope, keys, kind="in-toto"):  # what a known key has signed
	from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PublicKey as Key
	(one,), kind, body = envelope.signatures, f"application/vnd.{kind}+json", raw_of(envelope.payload)
	no(len(envelope) != 3 or envelope.payloadType != kind or len(one) != 2); key = keys[one.keyid]
	signed = b"DSSEv1 %d %b %d %b" % (len(kind), kind.encode(), len(body), body)
	Key.from_public_bytes(raw_of(key.key)).verify(raw_of(one.sig), signed); return body, key
def void(key, at, policy, body=b"", subject=()):  # revoked, or too late
	return {one[-64:] for one in policy.revoked} & {sha(raw_of(key.key)), sha(body), *(hex for one in
		subject for hex in one.digest.values())} or key.revoked or at > when(key.until or NEVER)
def recorder(log):  # who has signed the head of a log
	policy, keys = trusted(); body, key = opened(log.signed, keys, "smsl-studio.log-head")
	no(key.roles != ["recorder"] or void(key, when(log.wall_time), policy) or body != log.head)
	return key.person
def judge(known, log, closure, day=0, bot={"automatic", "recorder"}):  # why it is not approved
	(policy, keys), raw, last, ask, before = trusted(), load(known[closure].record), {}, [], 0
	no(not raw, "nobody has signed it"); told = [opened(one, keys) for one in read(raw).records]
	ran, day = log.policy or Map(), day or when(log.wall_time if log else
		read(told[-1][0]).predicate.time); mine = ran.code and log.digests.closure == closure
	for body, key in told:  # the last word of each person counts; what ran is what was signed
		them, say = read(body).subject, read(body).predicate; at = when(say.time)
		who, may = same(key.person), {*map(same, key.roles)}; no(before and at <= before); before = at
		if at > day + dt.timedelta(minutes=5): continue  # signed later
		word = them[0].digest.closure == closure and not void(key, at, policy, body, them) and say.verdict
		good = word and day <= when(say.expires or
			NEVER) and day - at <= dt.timedelta(policy.get("valid_days", 1e5))
		good = good and not (mine and ran.code != sha(plain(say.worlds[log.world])) or any(one.code !=
			sha(f"{one.id} {ran.rules}".encode()) for one in say.rules if ran.rules))
		for one in say.relies_on: good = good and not judge(known, log, one.digest.closure, day)
		no(good and may & bot and policy.automatic != "may_sign", "a program signs")
		last[who] = word if word == "rejected" else good and not may & bot and may
		ask = [a for a in ask if (a[0] != who or say.met) and not (last[who] and a[1] in say.met and a[2]
			& may)]; ask += [(who, text, may) for text in say.conditions if last[who]]
	seats = [same(role) for role, n in Map(policy.roles).items() for _ in range(min(n, 99))]
	ok = [*filter(None, last.values())]; few = len(ok) < max(1, policy.get("persons", len(seats)))
	bad = "rejected" in ok and "rejected" or (few or not each(seats, ok)) and "too few sign"
	for a in ask: bad = bad or last[a[0]] and a[1] not in log.met and "a condition is open: " + a[1]
	return bad
def real(file): return file.is_file() > file.is_symlink()
def files(way): return sorted(filter(real, pathlib.Path().glob(way)))
def load(name): return pathlib.Path(name).read_bytes() if real(pathlib.Path(name)) else b""
def main():  # 5 THE FOLDER
	wrong, records = [], files("records/**/*"); said = [f"Not checked: {one}." for one in NOT_CHECKED]
	def tried(place, act, *given):
		try: return act(*given)
		except Exception as error: wrong.append(f"{place}: {str(error) or repr(error)}"[:500])
	known = {c.hexes[3]: c for one in files("content/**/closure.json") if (c := tried(one, lambda:
		content([load(one.with_stem(p)) for p in PARTS], f"records{str(one.parent)[7:]}.record.json")))}
	hexes = {0, *(tried(one, lambda: sha(load(one))) for one in files("blueprint/**/*"))}
	logs = [tried(one, lambda: tell(known, load(one), hexes)) or Map() for one in files("logs/*")]
	said += [f"The head of a log is signed by {h.signed and tried('head', recorder, h) or 'nobody'}."
		for h in logs]; page = load("report.html")
	tried("report.html", no, page and sha(page).encode() not in load("README.txt"))
	for log in (logs or [Map()]) * bool(records or files("policy.toml")):
		about = log and [log.digests.closure, *Map(log.procedures).values()]
		for one in about or [c for c in known if load(known[c].record)] or known:
			tried("records", lambda: no(why := judge(known, log, one), why))
	said += ["No log."] * (not logs) + ["No policy: one signature counts."] * (not load("policy.toml"))
	said += ["No record: nobody has approved this blueprint."] * (not records)
	for line in *said, *wrong, "Not consistent." if wrong else "Consistent.": print(ascii(line)[1:-1])
	return bool(wrong)
if __name__ == "__main__": sys.exit(main())
